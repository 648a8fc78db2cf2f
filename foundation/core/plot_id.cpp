// SPDX-License-Identifier: Apache-2.0
#include "core/plot_id.h"

#include <cmath>

#include "core/csv.h"
#include "core/error.h"
#include "core/list_of.h"
#include "core/text.h"

namespace plotscan {

std::optional<PlotId> PlotId::from(const nlohmann::json& value) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    const bool blank = text.find_first_not_of(" \t\r\n") == std::string::npos;
    return blank ? std::nullopt : std::optional(PlotId(text));
  }
  if (!value.is_number()) return std::nullopt;
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return std::nullopt;
  PlotId id(value.is_number_float() ? format_number(value.get<double>()) : value.dump());
  id.is_number_ = true;
  return id;
}

void to_json(nlohmann::json& document, const PlotId& id) {
  document = id.is_number_ ? nlohmann::json::parse(id.text_) : nlohmann::json(id.text_);
}

void from_json(const nlohmann::json& value, PlotId& id) {
  const std::optional<PlotId> read = PlotId::from(value);
  if (!read) throw InputError("a plot's id is " + value.dump() + "; it is a number or a text");
  id = *read;
}

std::string joined(const std::vector<PlotId>& ids) {
  return joined(list_of(ids, &PlotId::text), ", ");
}

}  // namespace plotscan
