// SPDX-License-Identifier: Apache-2.0
#include "view/internal/page.h"

#include <array>
#include <cmath>
#include <sstream>

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRect.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "core/angle.h"
#include "view/internal/window.h"

namespace plotscan::view {
namespace {

constexpr int kDpi = 72;  // a font's point is a pixel

// Draws what a page holds.
class Painter : public vtkContextItem {
 public:
  static Painter* New();

  bool Paint(vtkContext2D* painter) override {
    for (const auto& stroke : *strokes) stroke(*painter);
    return true;
  }

  const std::vector<std::function<void(vtkContext2D&)>>* strokes = nullptr;
};

vtkStandardNewMacro(Painter)

    std::vector<float> flat(const std::vector<Eigen::Vector2d>& places) {
  std::vector<float> numbers;
  for (const Eigen::Vector2d& place : places) {
    numbers.push_back(static_cast<float>(kSamples * place.x()));
    numbers.push_back(static_cast<float>(kSamples * place.y()));
  }
  return numbers;
}

// The line's dashes; a dash goes round the line's corners.
std::vector<std::vector<Eigen::Vector2d>> dashes_of(const std::vector<Eigen::Vector2d>& places,
                                                    double dash_px) {
  std::vector<std::vector<Eigen::Vector2d>> dashes{{places.front()}};
  bool drawn = true;
  double left_px = dash_px;
  for (std::size_t i = 1; i < places.size(); ++i) {
    Eigen::Vector2d at = places[i - 1];
    double length_px = (places[i] - at).norm();
    while (length_px > left_px) {
      at += (places[i] - at) * (left_px / length_px);
      length_px -= left_px;
      if (drawn) dashes.back().push_back(at);
      drawn = !drawn;
      if (drawn) dashes.push_back({at});
      left_px = dash_px;
    }
    left_px -= length_px;
    if (drawn) dashes.back().push_back(places[i]);
  }
  return dashes;
}

void style(vtkTextProperty& property, const Lettering& lettering, int samples) {
  property.SetFontFamilyToArial();
  property.SetFontSize(static_cast<int>(std::lround(samples * lettering.size_px)));
  property.SetColor(lettering.colour.red / 255.0, lettering.colour.green / 255.0,
                    lettering.colour.blue / 255.0);
  property.SetBold(lettering.bold ? 1 : 0);
  property.SetOrientation(degrees(lettering.turn_rad));
  property.SetJustification(static_cast<int>(lettering.across));
  property.SetVerticalJustification(static_cast<int>(lettering.upwards));
}

}  // namespace

void Page::line(const std::vector<Eigen::Vector2d>& places, const Stroke& stroke) {
  if (places.size() < 2) return;
  const auto lines = stroke.dash_px > 0 ? dashes_of(places, stroke.dash_px)
                                        : std::vector<std::vector<Eigen::Vector2d>>{places};
  for (const auto& piece : lines) {
    if (piece.size() < 2) continue;
    strokes_.push_back([numbers = flat(piece), stroke](vtkContext2D& painter) mutable {
      painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
      painter.GetPen()->SetColor(stroke.colour.red, stroke.colour.green, stroke.colour.blue);
      painter.GetPen()->SetWidth(static_cast<float>(kSamples * stroke.width_px));
      painter.DrawPoly(numbers.data(), static_cast<int>(numbers.size() / 2));
    });
  }
}

void Page::area(const std::vector<Eigen::Vector2d>& corners, const Rgb& colour, double opacity) {
  strokes_.push_back([numbers = flat(corners), colour, opacity](vtkContext2D& painter) mutable {
    painter.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter.GetBrush()->SetColor(colour.red, colour.green, colour.blue);
    painter.GetBrush()->SetOpacityF(opacity);
    painter.DrawPolygon(numbers.data(), static_cast<int>(numbers.size() / 2));
  });
}

void Page::band(const std::vector<Eigen::Vector2d>& low, const std::vector<Eigen::Vector2d>& high,
                const Rgb& colour, double opacity) {
  std::vector<Eigen::Vector2d> strip;
  for (std::size_t i = 0; i < low.size(); ++i) {
    strip.push_back(low[i]);
    strip.push_back(high[i]);
  }
  if (strip.size() < 4) return;
  strokes_.push_back([numbers = flat(strip), colour, opacity](vtkContext2D& painter) mutable {
    painter.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter.GetBrush()->SetColor(colour.red, colour.green, colour.blue);
    painter.GetBrush()->SetOpacityF(opacity);
    painter.DrawQuadStrip(numbers.data(), static_cast<int>(numbers.size() / 2));
  });
}

void Page::text(const Eigen::Vector2d& place, const std::string& words,
                const Lettering& lettering) {
  strokes_.push_back([place, words, lettering](vtkContext2D& painter) {
    style(*painter.GetTextProp(), lettering, kSamples);
    painter.DrawString(static_cast<float>(kSamples * place.x()),
                       static_cast<float>(kSamples * place.y()), vtkStdString(words));
  });
}

void Page::raster(const Eigen::Vector2d& place, const Raster& raster) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(raster.width, raster.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (const Rgb& pixel : raster.pixels) {
    *bytes++ = pixel.red;
    *bytes++ = pixel.green;
    *bytes++ = pixel.blue;
  }
  strokes_.push_back([place, held = vtkSmartPointer<vtkImageData>(image)](vtkContext2D& painter) {
    painter.GetBrush()->SetOpacityF(1);
    const int* size = held->GetDimensions();
    painter.DrawImage(
        vtkRectf(static_cast<float>(kSamples * place.x()), static_cast<float>(kSamples * place.y()),
                 static_cast<float>(kSamples * size[0]), static_cast<float>(kSamples * size[1])),
        held);
  });
}

void Page::write(const std::filesystem::path& png) const {
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is thrown, not printed
  vtkNew<Painter> painter;
  painter->strokes = &strokes_;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(painter);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  prepare_offscreen(*window, kSamples * static_cast<int>(size_px_.x()),
                    kSamples * static_cast<int>(size_px_.y()));
  window->SetDPI(kDpi);
  window->AddRenderer(renderer);
  render_png(*window, png, kSamples);
}

Eigen::Vector2d text_size_px(const std::string& words, const Lettering& lettering) {
  vtkNew<vtkTextProperty> property;
  Lettering level = lettering;
  level.turn_rad = 0;
  style(*property, level, kSamples);
  std::array<int, 4> box{};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, vtkStdString(words), box.data(), kDpi);
  return Eigen::Vector2d(box[1] - box[0] + 1, box[3] - box[2] + 1) / kSamples;
}

std::vector<std::string> wrapped(const std::string& words, double width_px,
                                 const Lettering& lettering) {
  std::vector<std::string> lines;
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (lines.empty() || text_size_px(longer, lettering).x() > width_px)
      lines.push_back(word);
    else
      lines.back() = longer;
  }
  return lines;
}

}  // namespace plotscan::view
