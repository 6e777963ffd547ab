#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A data set in a PyTorch training loop: ship against decoys by a small network on the range-velocity maps.

    python3 train_on_maps.py set --scenario quick.yaml

makes the data set in the folder `set` if it is not there (the program `seaglint`, some minutes) and states the accuracy
on seas that the network has not seen. Needs python3-torch and python3-h5py.
"""
import argparse
import os
import subprocess

import numpy as np
import torch

import seaglint


def generate(folder, scenario, changes):
    """The data set by the program; goes on with what an interrupted run has left."""
    program = os.environ.get("SEAGLINT", "seaglint")
    changes = [word for change in changes for word in ("--set", change)]
    done = subprocess.run([program, "generate", scenario, "-o", folder, "--resume", *changes])
    if done.returncode != 0:
        raise SystemExit(done.returncode)


def normalised(magnitude):
    """A map in dB below its own peak, -40 dB as 0 and the peak as 1.

    The absolute level gives the class away where clutter is scaled to the target; each map has its own peak as 0 dB.
    """
    level_db = 20 * torch.log10(torch.clamp(magnitude / magnitude.max(), min=1e-6))
    return torch.clamp(level_db / 40 + 1, min=0)


def folds_of_seas(columns, count, seed):
    """The fold of every sample. All maps of one sea realisation (column `group`) are in one fold.

    Maps of one sea resemble each other: a split map by map would test the network on seas that it has learnt. Seas of
    every sea state are dealt to the folds in turn, so that each fold has all wave heights.
    """
    random = np.random.default_rng(seed)
    fold = np.empty(len(columns["group"]), int)
    turn = 0
    for state in np.unique(columns["sea_state"]):
        for group in random.permutation(np.unique(columns["group"][columns["sea_state"] == state])):
            fold[columns["group"] == group] = turn % count
            turn += 1
    return fold


def network():
    layers = []
    for channels_in, channels in ((1, 8), (8, 16), (16, 32)):
        layers += [torch.nn.Conv2d(channels_in, channels, 5, stride=2, padding=2), torch.nn.BatchNorm2d(channels), torch.nn.ReLU()]
    return torch.nn.Sequential(*layers, torch.nn.AdaptiveAvgPool2d((2, 4)), torch.nn.Flatten(), torch.nn.Linear(32 * 8, 1))


def learn(maps, train, epochs, workers):
    model = network()
    optimiser = torch.optim.Adam(model.parameters(), lr=1e-3)
    loss_of = torch.nn.BCEWithLogitsLoss()
    loader = torch.utils.data.DataLoader(torch.utils.data.Subset(maps, train), batch_size=16, shuffle=True, num_workers=workers, persistent_workers=workers > 0)
    model.train()
    for _ in range(epochs):
        for batch, label in loader:
            optimiser.zero_grad()
            loss = loss_of(model(batch)[:, 0], label.float())
            loss.backward()
            optimiser.step()
    return model


def correct(model, maps, test):
    """Whether each of the test maps is classified correctly, in their order."""
    loader = torch.utils.data.DataLoader(torch.utils.data.Subset(maps, test), batch_size=64)
    model.eval()
    with torch.no_grad():
        return np.concatenate([((model(batch)[:, 0] > 0) == (label == 1)).numpy() for batch, label in loader])


def interval(accuracy, observations):
    """95 % interval of a fraction (Wilson 1927)."""
    z = 1.96
    centre = (accuracy + z**2 / (2 * observations)) / (1 + z**2 / observations)
    half = z / (1 + z**2 / observations) * np.sqrt(accuracy * (1 - accuracy) / observations + z**2 / (4 * observations**2))
    return centre - half, centre + half


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("data", help="folder of the data set")
    options.add_argument("--scenario", default="quick.yaml", help="of a new data set")
    options.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="value of the scenario of a new data set, e.g. dataset.realisations_per_case=10 (repeatable)")
    options.add_argument("--epochs", type=int, default=15)
    options.add_argument("--folds", type=int, default=5)
    options.add_argument("--workers", type=int, default=2, help="processes that read maps")
    options.add_argument("--seed", type=int, default=1)
    given = options.parse_args()

    if not os.path.exists(os.path.join(given.data, "manifest.json")):
        generate(given.data, given.scenario, given.set)
    data = seaglint.Dataset(given.data)
    if len(data.classes) != 2:
        raise SystemExit(f"train_on_maps: {given.data}: {len(data.classes)} classes: this example has one output, for two")
    maps = data.torch_dataset("label", normalised)  # items: ([1, velocity, range] float32, 1 = ship or 0 = decoys)
    fold = folds_of_seas(data.columns, given.folds, given.seed)
    seas = len(np.unique(data.columns["group"]))
    if len(np.unique(fold)) < given.folds or given.folds < 2:
        raise SystemExit(f"train_on_maps: {seas} seas for {given.folds} folds: must be at least 2 folds, and a sea for each")

    # Every sea is tested once, by a network that has not seen it.
    torch.manual_seed(given.seed)
    right = np.empty(len(data), bool)
    for k in range(given.folds):
        train, test = np.flatnonzero(fold != k), np.flatnonzero(fold == k)
        assert not set(data.columns["group"][train]) & set(data.columns["group"][test])
        right[test] = correct(learn(maps, train, given.epochs, given.workers), maps, test)
        print(f"fold {k + 1} of {given.folds}: {len(train)} maps to learn, {len(test)} of other seas: {100 * right[test].mean():.1f} % correct", flush=True)

    # Maps of one sea are not independent. A sea counts as one observation, which is on the safe side: the variance of
    # a fraction with mean p is at most p (1 - p).
    low, high = interval(right.mean(), seas)
    print(f"accuracy on unseen seas: {100 * right.mean():.1f} % (95 % interval {100 * low:.0f} to {100 * high:.0f} %; {len(data)} maps of {seas} seas)")


if __name__ == "__main__":  # workers may import this file
    main()
