// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace plotscan {

// A plot's id as people write it: a number or a text. It keeps its kind when written: 101 as a
// number, "A-12" and "0101" as texts. Two ids that read alike are equal, whatever their kind.
class PlotId {
 public:
  // Implicit: programs number the plots that they find.
  PlotId(std::uint64_t number = 0) : text_(std::to_string(number)), is_number_(true) {}
  explicit PlotId(std::string text) : text_(std::move(text)) {}
  // A JSON value as an id: a finite number or a text that is not blank, else absent.
  static std::optional<PlotId> from(const nlohmann::json& value);

  const std::string& text() const { return text_; }
  friend void to_json(nlohmann::json& document, const PlotId& id);
  // Throws InputError where that is absent.
  friend void from_json(const nlohmann::json& value, PlotId& id);

  friend bool operator==(const PlotId& a, const PlotId& b) { return a.text_ == b.text_; }
  friend bool operator<(const PlotId& a, const PlotId& b) { return a.text_ < b.text_; }
  friend std::ostream& operator<<(std::ostream& out, const PlotId& id) { return out << id.text_; }

 private:
  std::string text_;
  bool is_number_ = false;
};

// "7, A-12".
std::string joined(const std::vector<PlotId>& ids);

}  // namespace plotscan
