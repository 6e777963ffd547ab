// SPDX-License-Identifier: BSD-3-Clause
// Metadata of the Hugging Face Hub; tests/pipeline/card_test.cpp reads them with a parser of YAML.
#include "classify/dataset/cards/hub_card.h"

#include <gtest/gtest.h>

namespace seaglint {
namespace {

TEST(HubCard, HasTheSizeCategoryWhoseLowerBoundIsIncluded) {
  EXPECT_EQ(hub_size_category(1), "n<1K");
  EXPECT_EQ(hub_size_category(999), "n<1K");
  EXPECT_EQ(hub_size_category(1000), "1K<n<10K");
  EXPECT_EQ(hub_size_category(10200), "10K<n<100K");
  EXPECT_EQ(hub_size_category(999999999), "100M<n<1B");
  EXPECT_EQ(hub_size_category(1000000000), "1B<n<10B");
}

TEST(HubCard, HasTheHubsIdentifierOfALicenceInSpdxSpelling) {
  EXPECT_EQ(hub_licence("CC-BY-SA-4.0"), "cc-by-sa-4.0");
  EXPECT_EQ(hub_licence("MIT"), "mit");
  EXPECT_EQ(hub_licence("ODC-By-1.0"), "odc-by");
  EXPECT_EQ(hub_licence("GPL-3.0-only"), "");
}

}  // namespace
}  // namespace seaglint
