// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What only the user knows of a data set that is handed to others. Nothing here has a default: what is not given is
// left out of the cards.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

struct Publication {
  std::string name;                        // title; the scenario's name if empty
  std::string licence;                     // identifier of the SPDX list (CC-BY-4.0), LicenseRef-NAME or a URL
  std::vector<std::string> creators;       // persons
  std::vector<std::string> organisations;  // creators too
  std::string url;                         // page of the data set
  std::string date;                        // of publication, YYYY-MM-DD
  std::string version;                     // of the data set, MAJOR.MINOR.PATCH
};

// Each returns what is wrong with a value of its member, or an empty string.
std::string name_problem(const std::string& name);
std::string licence_problem(const std::string& licence);
std::string url_problem(const std::string& url);
std::string date_problem(const std::string& date);
std::string version_problem(const std::string& version);

bool is_url(std::string_view text);         // http or https
bool is_identifier(std::string_view text);  // letters, digits, - . + as in SPDX identifiers and version numbers

}  // namespace seaglint
