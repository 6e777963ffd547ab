# SPDX-License-Identifier: BSD-3-Clause
# Labels: `root` (skipped without root), `browser` (headless Chromium), `slow` (some ten seconds and more each), `fast`
# (less than a minute for all of them on two cores). Tests of a second and more, and those that run the program, have
# none. Filters as GoogleTest has them; test_architecture sees that each names a test.
set(root_tests
  --gtest_filter=DiskErrors.*:InterruptedGenerate.WritesTheSameBytesInTwoContainersWithOneProcessNumber:SmallDisk.*
  --gtest_filter=Surroundings.OfAContainerGiveTheSameBytes
)
set(browser_tests
  --gtest_filter=RunOutput.EveryPictureOfTheReportLoadsInABrowser
)
set(slow_tests
  --gtest_filter=BodyOnDeck.FollowsImageTheory:ClutterFalseAlarms.AreRareInWaveResolvedClutter
  --gtest_filter=CoatedTarget.IntervalFollowsTheCoefficientsOfACurvedSurface:ConstantKeys.AreInNoScenarioOfTheProject
  --gtest_filter=ContributionBound.Holds*:DrawnJob.*Done*
  --gtest_filter=EchoOverTime.HasTheFeaturesAndProbabilitiesOfItsSampleToRounding:EchoOverTime.WithNoise*
  --gtest_filter=EdgeContributionBound.*:InjectedFaults.LoseNothing:MeasuredClutter.*
  --gtest_filter=IntervalResponse.MatchesIndependentTracesInRandomDirections:IntervalResponse.OfTheRollingShip*
  --gtest_filter=MechanismWorth.ShipAndDecoyChangeWithoutAMechanism:MemoryLimit.OfTheAddressSpaceEndsARunWithOneLine
  --gtest_filter=MeshInvariance.OfRandomBodies:Motion.DrawsRaosInTheScenariosUnitsAndDepth
  --gtest_filter=PlateEdges.HaveNoSpikesInAFullSweep:Rays.CanonicalBodiesAreWithinATenthOfADecibelOfBeams
  --gtest_filter=SeaReflection.ShipsResponseOverAnIntervalMatchesIndependentTraces:ShipCentres.*:ShipInClutter.*
  --gtest_filter=SmallBenchmark.HasAccuraciesInTheirIntervals*:SmallBenchmark.HasTheFiguresAndTheModelOfARun
  --gtest_filter=Spreading.CorrelationAcrossTheWavesEqualsItsIntegral:Stopped.*:Surroundings.OfMissingFolders*
  --gtest_filter=Surroundings.WithoutAnEnvironment*:Sweep.HasTheCoefficientsOfMaterialsAtEveryFrequency
  --gtest_filter=SurfacePropagation.FloatInWavesFadesAsTheMeasuredOne
  --gtest_filter=Sweep.HasTheEchoOfEveryFrequencyAlone:ThreeClasses.OfAnotherDataSetOrModelAreRefused
  --gtest_filter=WavefrontCurvature.OfATrihedralIsThatOfItsAperture
)
set(rest_tests "*")
set(medium_tests
  --gtest_filter=BatteredDecoys.*:Benchmark.EveryShippedOne*:BodiesInWater.OfA*:BodyOnDeck.*:Bombs.*:CavityEcho.*:CentresInClutter.*
  --gtest_filter=CleanCentres.Outside*:Clutter.*:ClutterFalseAlarms.*:CoatedTarget.*:ContributionBound.*
  --gtest_filter=CurvedSurface.*:CylinderBeforeAPatch.*:DecoyMedian.*:EdgeDiffraction.*:Evaluation.*:FieldExport.*
  --gtest_filter=*Fleet.*:FuzzInputs.*:InfinitePrism.*:Interpolation.HasTheStated*:IntervalResponse.*
  --gtest_filter=ClutterModulatedByTheWaves.*:ModulatedScatterers.*:ScatterersOnTheWaves.*:ClutterLevel.*
  --gtest_filter=MatchedTraining.*:MechanismWorth.*:MergedDataSet.HasTheSameBytes*:MergedFacets.*:Looks.*:Rigidity.*
  --gtest_filter=MeshFile.SixtyThousand*:MotionSummary.*:MultipleDiffraction.*:Network.*:PartSums.*:Pedestal.*:PermutedLabels.*
  --gtest_filter=PlateEdges.*:Progress.*:Rays.*:RigidRaft.Moves*:Rounding.*:RoundTrip.EveryField*:SampleCrossCheck.*
  --gtest_filter=ScenarioFuzzing.*:SeaReflection.*:SeaReflectivity.*:ShardFile.*:ShipRao.*:SimulateRao.*
  --gtest_filter=SimulateShip.*:SurfacePropagation.*:Sweep.*:TextTableFuzzing.*:TopHat.*:Training.*:ViewEstimate.*:WallCurrents.*
  --gtest_filter=WallPatches.*:WallPenumbra.*:WavefrontCurvature.*:WavesBetween.*:WorkEstimate.*
)
