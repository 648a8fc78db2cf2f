// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

class vtkContext2D;

namespace plotscan::view {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

// Colours that colour-blind readers tell apart (Okabe and Ito, "Color Universal Design", 2008).
inline constexpr Rgb kBlue{0, 114, 178};
inline constexpr Rgb kVermilion{213, 94, 0};
inline constexpr Rgb kPurple{204, 121, 167};
inline constexpr Rgb kOrange{230, 159, 0};
inline constexpr Rgb kGreen{0, 158, 115};
inline constexpr Rgb kSky{86, 180, 233};
inline constexpr Rgb kIndigo{51, 34, 136};
inline constexpr Rgb kDarkGrey{77, 77, 77};
inline constexpr Rgb kInk{34, 34, 34};
inline constexpr Rgb kGrey{150, 150, 150};
inline constexpr Rgb kWhite{255, 255, 255};

// Text size as a share of a picture's width: 7 points on a page 17 cm wide.
inline constexpr double kTextShare = 0.0145;

// A picture of square pixels, rows from the lower one up.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels = {};
};

struct Stroke {
  Rgb colour = kInk;
  double width_px = 1;
  double dash_px = 0;  // length of dashes, and of the gaps between them; 0: solid
};

enum class Side { low, middle, high };  // left, centre, right; bottom, middle, top

struct Lettering {
  double size_px = 16;
  Rgb colour = kInk;
  Side across = Side::low;      // which part of the text stands at its place, along the text
  Side upwards = Side::middle;  // across the text
  double turn_rad = 0;          // counter-clockwise
  bool bold = false;
};

// A page to draw on; each new thing covers those drawn before. Places are pixels from the lower
// left corner.
class Page {
 public:
  explicit Page(const Eigen::Vector2d& size_px) : size_px_(size_px) {}

  void line(const std::vector<Eigen::Vector2d>& places, const Stroke& stroke);
  // A filled convex polygon.
  void area(const std::vector<Eigen::Vector2d>& corners, const Rgb& colour, double opacity = 1);
  // The area between two lines with equally many points.
  void band(const std::vector<Eigen::Vector2d>& low, const std::vector<Eigen::Vector2d>& high,
            const Rgb& colour, double opacity);
  void text(const Eigen::Vector2d& place, const std::string& words, const Lettering& lettering);
  // One pixel of the raster on one of the page; `place` is its lower left corner.
  void raster(const Eigen::Vector2d& place, const Raster& raster);
  // Writes a PNG as render_png does. Needs a Display.
  void write(const std::filesystem::path& png) const;

 private:
  Eigen::Vector2d size_px_;
  std::vector<std::function<void(vtkContext2D&)>> strokes_;
};

// The words in as many lines as keep to a width.
std::vector<std::string> wrapped(const std::string& words, double width_px,
                                 const Lettering& lettering);

// Size of the text as it is drawn: width along the text, and height.
Eigen::Vector2d text_size_px(const std::string& words, const Lettering& lettering);

}  // namespace plotscan::view
