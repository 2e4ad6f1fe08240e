#include "common/ingest/esri_ascii.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {
namespace {

struct Header {
  std::optional<double> columns, rows, x_corner, x_center, y_corner, y_center, cell, dx, dy,
      missing;
};

// The place of a key's value, or null.
std::optional<double>* Slot(Header& header, absl::string_view key) {
  const std::string lower = absl::AsciiStrToLower(key);
  if (lower == "ncols") return &header.columns;
  if (lower == "nrows") return &header.rows;
  if (lower == "xllcorner") return &header.x_corner;
  if (lower == "xllcenter" || lower == "xllcentre") return &header.x_center;
  if (lower == "yllcorner") return &header.y_corner;
  if (lower == "yllcenter" || lower == "yllcentre") return &header.y_center;
  if (lower == "cellsize") return &header.cell;
  if (lower == "dx") return &header.dx;
  if (lower == "dy") return &header.dy;
  if (lower == "nodata_value") return &header.missing;
  return nullptr;
}

bool IsWhole(double value, double low, double high) {
  return value >= low && value <= high && value == std::floor(value);
}

// Reads keys until a line that starts with none; that line is then the current one.
absl::StatusOr<Header> ReadHeader(TextLines& lines) {
  Header header;
  while (lines.NextNotBlank()) {
    absl::string_view rest = lines.line();
    const absl::string_view key = TakeField(rest), value = TakeField(rest);
    std::optional<double>* slot = Slot(header, key);
    if (slot == nullptr) return header;
    if (slot->has_value()) return lines.Error(key, "given twice");
    *slot = ParseReal(value);
    if (!slot->has_value()) return lines.Bad(key, value, "a number");
    if (!TakeField(rest).empty()) return lines.Bad(key, lines.line(), "one number");
  }
  return lines.Truncated("the first row");
}

absl::StatusOr<RawGrid> GridOf(const Header& header, absl::string_view name) {
  const auto bad = [name](absl::string_view field, absl::string_view problem) {
    return FileError(name, 0, field, problem);
  };
  RawGrid grid;
  for (const auto& [key, value, sink] : {std::tuple("ncols", header.columns, &grid.columns),
                                         std::tuple("nrows", header.rows, &grid.rows)}) {
    if (!value.has_value()) return bad(key, "missing in the header");
    if (!IsWhole(*value, 2, kTerrainSideMax)) {
      return bad(key, absl::StrCat(*value, " is not a number from 2 to ", kTerrainSideMax));
    }
    *sink = static_cast<int>(*value);
  }
  if (header.cell.has_value()) {
    grid.dx = grid.dy = *header.cell;
  } else if (header.dx.has_value() && header.dy.has_value()) {
    grid.dx = *header.dx;
    grid.dy = *header.dy;
  } else {
    return bad("cellsize", "missing in the header");
  }
  if (!(grid.dx > 0.0 && grid.dy > 0.0)) return bad("cellsize", "not positive");
  if (header.x_corner.has_value() == header.x_center.has_value()) {
    return bad("xllcorner", "the header needs either this or xllcenter");
  }
  if (header.y_corner.has_value() == header.y_center.has_value()) {
    return bad("yllcorner", "the header needs either this or yllcenter");
  }
  grid.x0 = header.x_corner ? *header.x_corner + 0.5 * grid.dx : *header.x_center;
  grid.y0 = header.y_corner ? *header.y_corner + 0.5 * grid.dy : *header.y_center;
  return grid;
}

}  // namespace

bool LooksLikeEsriAscii(absl::string_view text) {
  TextLines lines("", text);
  if (!lines.NextNotBlank()) return false;
  absl::string_view rest = lines.line();
  Header unused;
  return Slot(unused, TakeField(rest)) != nullptr;
}

absl::StatusOr<RawGrid> ParseEsriAscii(absl::string_view name, absl::string_view text) {
  TextLines lines(name, text);
  const absl::StatusOr<Header> header = ReadHeader(lines);
  if (!header.ok()) return header.status();
  absl::StatusOr<RawGrid> grid = GridOf(*header, name);
  if (!grid.ok()) return grid;
  const std::size_t cells = static_cast<std::size_t>(grid->columns) * grid->rows;
  if (cells > text.size() / 2 + 1) return lines.Truncated("samples");  // before memory is taken
  grid->value.resize(cells);
  absl::string_view rest = lines.line();
  for (int row = grid->rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid->columns; ++column) {
      absl::string_view field = TakeField(rest);
      while (field.empty()) {
        if (!lines.Next()) return lines.Truncated("samples");
        rest = lines.line();
        field = TakeField(rest);
      }
      const std::optional<double> value = ParseReal(field);
      if (!value.has_value()) return lines.Bad("sample", field, "a number");
      const bool missing = header->missing.has_value() && *value == *header->missing;
      if (!missing && !(std::abs(*value) <= kDepthMaxM)) {
        return lines.Error("sample", absl::StrCat(*value, " is beyond ±", kDepthMaxM, " m"));
      }
      grid->value[static_cast<std::size_t>(row) * grid->columns + column] =
          missing ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(*value);
    }
  }
  if (!TakeField(rest).empty() || lines.NextNotBlank()) {
    return lines.Error("samples", absl::StrCat("more than ncols x nrows = ", cells));
  }
  return grid;
}

}  // namespace onesea::ingest
