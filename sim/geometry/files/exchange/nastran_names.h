// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of properties, which pre-processors write into comments of NASTRAN bulk data.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace seaglint {

class NastranNames {
 public:
  // Takes the name from a comment, which begins with its $:
  //   $HMNAME PROP 7"hull" 4, $HMNAME COMP 7"hull" 7 "shell" 4                  HyperMesh
  //   $ANSA_NAME_COMMENT;7;PSHELL;hull;...                                      ANSA
  //   $ Femap Property 7 : hull, $ Femap with NX Nastran Property 7 : hull      Femap
  //   $ Elements and Element Properties for region : hull                      Patran, for the next property card
  void comment(std::string_view line);
  // A property card, which a comment of Patran may precede.
  void property(std::int64_t number);

  const std::map<std::int64_t, std::string>& all() const { return names_; }

 private:
  void add(std::int64_t number, std::string_view name, bool overwrite);

  std::map<std::int64_t, std::string> names_;
  std::optional<std::string> region_;
};

}  // namespace seaglint
