// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/random.h"
#include "core/range.h"

namespace plotscan::crop {

// A botanical parameter as its crop's file states it (docs/plants.md).
struct Parameter {
  std::string name;
  double value = 0;       // unused where every stage has its own
  bool by_stage = false;  // every stage gives its value
  Range range{};
  std::string unit = {};  // "m", "deg", "share", ...; "count": whole numbers
  std::string meaning = {};
  std::string source = {};

  bool whole() const { return unit == "count"; }
  // "a whole number in [3, 30]"
  std::string allowed() const;
};

// A growth stage: the parameters that it changes, and published facts of a default plot at it.
struct Stage {
  std::string name;
  std::string meaning = {};
  std::map<std::string, double> values = {};  // of the parameters by stage
  Range height_m{};                           // of the canopy
  Range leaf_area_index{};
  Range leaf_inclination_deg{};  // mean over the leaf area, from the horizontal
  std::string source = {};
};

// A crop as its file describes it.
struct Cultivar {
  std::string crop;
  std::string species;
  std::string default_stage;
  double plants_per_m2 = 0;  // of the default plot
  double row_spacing_m = 0;
  std::string plot_source;
  std::map<std::string, Eigen::Vector3f> colours;  // by material
  // Diffuse reflectance at 903 nm, by material; other materials have that of their name
  // (mesh/reflectance.h).
  std::map<std::string, float> reflectance = {};
  std::vector<Parameter> parameters;
  std::vector<Stage> stages;  // in the order in which the crop passes through them

  // The stage of that name; the default stage for "". Throws InputError on another.
  const Stage& stage(const std::string& name) const;
};

// Reads a crop's whole file, CROP.yaml, from its text; `file` is its name in errors. Throws
// InputError on an unsound file, and on one that names another crop.
Cultivar parse_cultivar(const std::string& text, const std::filesystem::path& file);
// A user's file of the same format, in which all but `crop` may be left out, over the crop's own.
// Parameters and stages must be the crop's, ranges within the crop's. Throws InputError.
Cultivar override_cultivar(const Cultivar& cultivar, const std::filesystem::path& file);

// The value of every parameter of a plant at one stage.
class Traits {
 public:
  // With "key=value" assignments applied. Throws InputError on an unknown key, or a value that is
  // not a number in the key's range.
  Traits(const Cultivar& cultivar, const Stage& stage, const std::vector<std::string>& assignments);

  double operator[](const std::string& name) const;
  int count(const std::string& name) const;
  double radians(const std::string& name) const;  // of a parameter in degrees
  // The value with the cultivar's `variation` from organ to organ.
  double vary(double value, RandomStream& random) const;

 private:
  std::map<std::string, double> values_;
};

}  // namespace plotscan::crop
