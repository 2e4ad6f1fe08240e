#include "client/app/stroke_font.h"

#include <algorithm>
#include <map>
#include <string>

namespace onesea::app {
namespace {

// A glyph is strokes, separated by '|', of points "xy" on a grid: x from 0, y 2 at the baseline, 6
// at the height of small letters, 8 at that of capitals. A stroke after '~' is a curve (quadratic
// B-spline) with these control points: open curves reach their ends, closed ones only touch the
// edges of the box they are drawn in.
struct Glyph {
  absl::string_view character;  // UTF-8
  absl::string_view strokes;
};

constexpr Glyph kGlyphs[] = {
    {"0", "~08 48 42 02 08"},
    {"1", "07 28 22"},
    {"2", "~06 08 48 45 12 02|02 42"},
    {"3", "~07 08 48 45 25|~25 45 42 02 03"},
    {"4", "32 38 04 44"},
    {"5", "48 08 05|~05 36 46 42 02 03"},
    {"6", "~38 08 04|~04 06 46 42 02 04"},
    {"7", "08 48 12"},
    {"8", "~18 38 45 05 18|~05 45 42 02 05"},
    {"9", "~12 42 46|~46 44 04 08 48 46"},
    {"A", "02 28 42|14 34"},
    {"B", "02 08 28|~28 48 45 25|05 25|~25 45 42 22|22 02"},
    {"C", "~47 48 08 02 42 43"},
    {"D", "02 08 18|~18 48 42 12|12 02"},
    {"E", "48 08 02 42|05 35"},
    {"F", "48 08 02|05 35"},
    {"G", "~47 48 08 02 42 44|45 25|45 42"},
    {"H", "08 02|48 42|05 45"},
    {"I", "08 02"},
    {"J", "38 34|~34 32 02 04"},
    {"K", "08 02|48 04|15 42"},
    {"L", "08 02 42"},
    {"M", "02 08 25 48 42"},
    {"N", "02 08 42 48"},
    {"O", "~08 48 42 02 08"},
    {"P", "02 08 28|~28 48 44 24|24 04"},
    {"Q", "~08 48 42 02 08|23 41"},
    {"R", "02 08 28|~28 48 44 24|24 04|24 42"},
    {"S", "~47 48 08 05 45 42 02 03"},
    {"T", "08 48|28 22"},
    {"U", "08 04|~04 02 42 44|44 48"},
    {"V", "08 22 48"},
    {"W", "08 12 26 32 48"},
    {"X", "08 42|02 48"},
    {"Y", "08 25 48|25 22"},
    {"Z", "08 48 02 42"},
    {"a", "36 32|~36 06 02 32 36"},
    {"b", "08 02|~06 36 32 02 06"},
    {"c", "~35 36 06 02 32 33"},
    {"d", "38 32|~36 06 02 32 36"},
    {"e", "04 34|~34 36 06 02 32 33"},
    {"f", "~28 18 16|16 12|06 26"},
    {"g", "36 31|~31 30 00 01|~36 06 02 32 36"},
    {"h", "08 02|~04 06 36 34|34 32"},
    {"i", "06 02|08 08"},
    {"j", "16 11|~11 10 00|18 18"},
    {"k", "08 02|36 04|14 32"},
    {"l", "08 02"},
    {"m", "06 02|~04 06 26 24|24 22|~24 26 46 44|44 42"},
    {"n", "06 02|~04 06 36 34|34 32"},
    {"o", "~06 36 32 02 06"},
    {"p", "06 00|~06 36 32 02 06"},
    {"q", "36 30|~06 36 32 02 06"},
    {"r", "06 02|~04 06 26"},
    {"s", "~35 36 06 04 34 32 02 03"},
    {"t", "18 13|~13 12 22|06 26"},
    {"u", "06 04|~04 02 32 34|36 32"},
    {"v", "06 22 46"},
    {"w", "06 12 25 32 46"},
    {"x", "06 32|02 36"},
    {"y", "06 22|46 10"},
    {"z", "06 36 02 32"},
    {".", "02 02"},
    {",", "12 01"},
    {":", "02 02|05 05"},
    {";", "15 15|12 01"},
    {"-", "05 35"},
    {"_", "02 42"},
    {"+", "05 45|27 23"},
    {"=", "04 44|06 46"},
    {"/", "02 48"},
    {"(", "~18 07 03 12"},
    {")", "~08 17 13 02"},
    {"[", "18 08 02 12"},
    {"]", "08 18 12 02"},
    {"'", "08 06"},
    {"!", "08 04|02 02"},
    {"?", "~07 08 48 45 24|22 22"},
    {"#", "13 17|33 37|04 44|06 46"},
    {"%", "02 48|08 08|42 42"},
    {"\xc2\xb0", "~08 28 26 06 08"},
    {"\xc2\xb2", "~07 08 28 27 05|05 25"},
    {"\xc2\xb7", "05 05"},
};

constexpr double kUnitsOfCapital = 6.0;
constexpr double kBaseline = 2.0;
constexpr double kGap = 1.9;
constexpr double kBlank = 2.6;

struct Outline {
  std::vector<Segment> segments;  // in grid units, y up from the baseline
  double width = 0.0;
};

// Chaikin's corner cutting, whose limit is the quadratic B-spline.
std::vector<Vec2d> Smooth(std::vector<Vec2d> points) {
  const bool is_closed = points.front().x == points.back().x && points.front().y == points.back().y;
  for (int round = 0; round < 4; ++round) {
    std::vector<Vec2d> cut;
    if (!is_closed) cut.push_back(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vec2d a = points[i - 1], b = points[i];
      cut.push_back({0.75 * a.x + 0.25 * b.x, 0.75 * a.y + 0.25 * b.y});
      cut.push_back({0.25 * a.x + 0.75 * b.x, 0.25 * a.y + 0.75 * b.y});
    }
    cut.push_back(is_closed ? cut.front() : points.back());
    points = std::move(cut);
  }
  return points;
}

Outline Trace(absl::string_view strokes) {
  Outline outline;
  while (!strokes.empty()) {
    const absl::string_view stroke = strokes.substr(0, strokes.find('|'));
    strokes.remove_prefix(std::min(strokes.size(), stroke.size() + 1));
    std::vector<Vec2d> points;
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
      if (stroke[i] < '0' || stroke[i] > '9') continue;
      points.push_back({static_cast<double>(stroke[i] - '0'), stroke[i + 1] - '0' - kBaseline});
      outline.width = std::max(outline.width, points.back().x);
      ++i;
    }
    if (stroke[0] == '~') points = Smooth(std::move(points));
    for (std::size_t i = 1; i < points.size(); ++i) {
      outline.segments.push_back({points[i - 1], points[i]});
    }
  }
  return outline;
}

const std::map<std::string, Outline>& Outlines() {
  static const auto& outlines = *[] {
    auto* const all = new std::map<std::string, Outline>;
    for (const Glyph& glyph : kGlyphs) (*all)[std::string(glyph.character)] = Trace(glyph.strokes);
    return all;
  }();
  return outlines;
}

std::string TakeCharacter(absl::string_view& text) {
  std::size_t size = 1;
  while (size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) ++size;
  std::string character(text.substr(0, size));
  text.remove_prefix(size);
  return character;
}

// Calls `draw(outline, x)` for each character; returns the whole width in grid units.
template <typename Draw>
double Lay(absl::string_view text, Draw draw) {
  double x = 0.0;
  while (!text.empty()) {
    const std::string character = TakeCharacter(text);
    const auto outline = Outlines().find(character);
    if (outline != Outlines().end()) {
      draw(outline->second, x);
      x += outline->second.width + kGap;
    } else if (character == " ") {
      x += kBlank;
    }
  }
  return std::max(0.0, x - kGap);
}

}  // namespace

double TextWidth(absl::string_view text, double height_px) {
  return Lay(text, [](const Outline&, double) {}) * height_px / kUnitsOfCapital;
}

double TextPen(double height_px) { return std::max(1.1, 0.115 * height_px); }

std::vector<Segment> TextStrokes(Vec2d at, double height_px, absl::string_view text) {
  const double scale = height_px / kUnitsOfCapital;
  std::vector<Segment> strokes;
  Lay(text, [&](const Outline& outline, double x) {
    for (const Segment& s : outline.segments) {
      strokes.push_back({{at.x + (x + s.from.x) * scale, at.y - s.from.y * scale},
                         {at.x + (x + s.to.x) * scale, at.y - s.to.y * scale}});
    }
  });
  return strokes;
}

}  // namespace onesea::app
