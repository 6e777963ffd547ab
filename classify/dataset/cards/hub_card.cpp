// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/cards/hub_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/printable.h"

namespace seaglint {

namespace {

// The Hub's identifiers that are SPDX's in lower case (Hub documentation, "Licenses"); others are `other` with a name.
constexpr const char* kHubLicences[] = {"afl-3.0",
                                        "apache-2.0",
                                        "artistic-2.0",
                                        "bsd-2-clause",
                                        "bsd-3-clause",
                                        "bsd-3-clause-clear",
                                        "bsl-1.0",
                                        "cc-by-2.0",
                                        "cc-by-2.5",
                                        "cc-by-3.0",
                                        "cc-by-4.0",
                                        "cc-by-nc-2.0",
                                        "cc-by-nc-3.0",
                                        "cc-by-nc-4.0",
                                        "cc-by-nc-nd-3.0",
                                        "cc-by-nc-nd-4.0",
                                        "cc-by-nc-sa-2.0",
                                        "cc-by-nc-sa-3.0",
                                        "cc-by-nc-sa-4.0",
                                        "cc-by-nd-4.0",
                                        "cc-by-sa-3.0",
                                        "cc-by-sa-4.0",
                                        "cc0-1.0",
                                        "cdla-permissive-1.0",
                                        "cdla-permissive-2.0",
                                        "cdla-sharing-1.0",
                                        "ecl-2.0",
                                        "epl-1.0",
                                        "epl-2.0",
                                        "etalab-2.0",
                                        "eupl-1.1",
                                        "isc",
                                        "lppl-1.3c",
                                        "mit",
                                        "mpl-2.0",
                                        "ms-pl",
                                        "ncsa",
                                        "ofl-1.1",
                                        "osl-3.0",
                                        "postgresql",
                                        "unlicense",
                                        "wtfpl",
                                        "zlib"};

// Identifiers that differ.
struct RenamedLicence {
  const char* spdx;  // in lower case
  const char* hub;
};
constexpr RenamedLicence kRenamedLicences[] = {
    {"c-uda-1.0", "c-uda"}, {"odbl-1.0", "odbl"}, {"odc-by-1.0", "odc-by"}, {"pddl-1.0", "pddl"}};

// A double-quoted string of JSON is one of YAML.
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string licence_lines(const std::string& licence) {
  if (licence.empty()) return "";
  if (is_url(licence)) return fmt::format("license: other\nlicense_link: {}\n", quoted(licence));
  if (const std::string known = hub_licence(licence); !known.empty()) return fmt::format("license: {}\n", known);
  return fmt::format("license: other\nlicense_name: {}\n", quoted(licence));
}

}  // namespace

std::string hub_licence(const std::string& spdx) {
  std::string lower = spdx;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const RenamedLicence& renamed : kRenamedLicences) {
    if (lower == renamed.spdx) return renamed.hub;
  }
  return std::find(std::begin(kHubLicences), std::end(kHubLicences), lower) == std::end(kHubLicences) ? "" : lower;
}

std::string hub_size_category(std::uint64_t samples) {
  constexpr const char* kNames[] = {"n<1K",     "1K<n<10K",   "10K<n<100K", "100K<n<1M",
                                    "1M<n<10M", "10M<n<100M", "100M<n<1B",  "1B<n<10B"};
  std::size_t category = 0;
  for (std::uint64_t limit = 1000; samples >= limit && category + 1 < std::size(kNames); limit *= 10) ++category;
  return kNames[category];
}

std::string hub_front_matter(const Publication& publication, const std::string& title, std::uint64_t samples) {
  // The one split has a name of its own: `train` would suggest that others exist.
  return fmt::format(
      "---\npretty_name: {}\n{}task_categories:\n- image-classification\n- tabular-classification\n"
      "size_categories:\n- {}\nsource_datasets:\n- original\nannotations_creators:\n- machine-generated\n"
      "tags:\n- radar\n- range-velocity map\n- frequency agility\n- sea clutter\n- synthetic\n"
      "configs:\n- config_name: columns\n  data_files:\n  - split: samples\n    path: {}\n---\n",
      quoted(title), licence_lines(publication.licence), hub_size_category(samples), kColumnsFile);
}

std::string publication_sections(const Publication& publication, const std::string& citation) {
  std::string text = fmt::format(
      "\n## Files beside the shards\n\n"
      "`{}` has the columns of all samples in one table, with file (`shard`) and row (`row`) of every map; "
      "`{}` describes the data set\nin the Croissant format, with the SHA-256 of every file.\n\n## Licence\n\n",
      kColumnsFile, kCroissantFile);
  if (publication.licence.empty()) {
    text += "Not given by those who made this data set.\n";
  } else {
    text += is_url(publication.licence) ? fmt::format("<{}>\n", publication.licence)
                                        : fmt::format("{}\n", markdown_text(publication.licence));
  }
  std::string creators;
  for (const auto* names : {&publication.creators, &publication.organisations}) {
    for (const std::string& name : *names) creators += (creators.empty() ? "" : "; ") + markdown_text(name);
  }
  if (!creators.empty()) text += fmt::format("\nMade by {}.\n", creators);
  if (!publication.url.empty()) text += fmt::format("\n<{}>\n", publication.url);
  return text + fmt::format("\n## Citation of the simulator\n\n```bibtex\n{}\n```\n", citation);
}

}  // namespace seaglint
