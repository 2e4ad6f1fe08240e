#include "common/ingest/ndbc_spectrum.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/ingest/direction.h"
#include "common/ingest/spreading_moments.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {
namespace {

// The historical files round 999.00 to their columns' digits only.
bool IsMissing(double value) { return value >= 998.9 && value <= 999.1; }

// Both are ascending in time, so that the cursor only moves forward.
class RowAtTime {
 public:
  explicit RowAtTime(const NdbcTable& table) : table_(table) {}

  const NdbcRow* Find(const std::string& time_utc) {
    while (next_ < table_.rows.size() && table_.rows[next_].time_utc < time_utc) ++next_;
    const bool found = next_ < table_.rows.size() && table_.rows[next_].time_utc == time_utc;
    return found ? &table_.rows[next_] : nullptr;
  }
  const std::string& name() const { return table_.name; }

 private:
  const NdbcTable& table_;
  std::size_t next_ = 0;
};

// The value of one band in one line of a directional file, checked. No line, no such band or 999:
// nothing.
absl::Status ReadBand(const NdbcRow* row, const std::string& name, absl::string_view field,
                      float frequency_hz, double scale, double max, std::optional<double>& out) {
  out.reset();
  if (row == nullptr) return absl::OkStatus();
  const auto begin = row->frequency_hz.begin();
  const auto at = std::lower_bound(begin, row->frequency_hz.end(), frequency_hz);
  if (at == row->frequency_hz.end() || *at != frequency_hz) return absl::OkStatus();
  const double value = row->value[static_cast<std::size_t>(at - begin)];
  if (IsMissing(value)) return absl::OkStatus();
  // One part in a million for what is rounded to float.
  if (!(value >= 0.0 && value * scale <= max * (1.0 + 1e-6))) {
    return BadField(name, row->line, field, absl::StrFormat("%g", value),
                    absl::StrFormat("in [0, %g] (at %g Hz)", max / scale, frequency_hz));
  }
  out = std::min(value * scale, max);
  return absl::OkStatus();
}

struct DirectionalRows {
  RowAtTime alpha1, alpha2, r1, r2;
  double r_scale = 1.0;
};

struct BandDirection {
  std::optional<double> alpha1_deg, alpha2_deg, r1, r2;
};

void AppendDirection(const BandDirection& band, sea::BuoySpectrum& spectrum) {
  double mean = 0.0, principal = 0.0, r1 = 0.0, r2 = 0.0;
  if (band.alpha1_deg && band.r1) {
    mean = principal = WaveToFromNautical(*band.alpha1_deg);
    r1 = *band.r1;
    r2 = SecondMomentOfCosine2s(r1);
    if (band.alpha2_deg && band.r2) {
      principal = WaveToFromNautical(*band.alpha2_deg);
      r2 = *band.r2;
    }
  }
  spectrum.mean_wave_to_rad.push_back(static_cast<float>(mean));
  spectrum.principal_wave_to_rad.push_back(static_cast<float>(principal));
  spectrum.r1.push_back(static_cast<float>(r1));
  spectrum.r2.push_back(static_cast<float>(r2));
}

absl::Status AddDirections(const std::string& time_utc, DirectionalRows& rows,
                           sea::BuoySpectrum& spectrum) {
  const NdbcRow* const alpha1 = rows.alpha1.Find(time_utc);
  const NdbcRow* const alpha2 = rows.alpha2.Find(time_utc);
  const NdbcRow* const r1 = rows.r1.Find(time_utc);
  const NdbcRow* const r2 = rows.r2.Find(time_utc);
  if (alpha1 == nullptr || r1 == nullptr) return absl::OkStatus();
  for (const float f : spectrum.frequency_hz) {
    BandDirection band;
    ONESEA_RETURN_IF_ERROR(
        ReadBand(alpha1, rows.alpha1.name(), "alpha1", f, 1.0, 360.0, band.alpha1_deg));
    ONESEA_RETURN_IF_ERROR(
        ReadBand(alpha2, rows.alpha2.name(), "alpha2", f, 1.0, 360.0, band.alpha2_deg));
    ONESEA_RETURN_IF_ERROR(ReadBand(r1, rows.r1.name(), "r1", f, rows.r_scale, 1.0, band.r1));
    ONESEA_RETURN_IF_ERROR(ReadBand(r2, rows.r2.name(), "r2", f, rows.r_scale, 1.0, band.r2));
    AppendDirection(band, spectrum);
  }
  return absl::OkStatus();
}

// Bands that hold a value; hs_m stays 0 if none of them has energy.
absl::Status ReadDensity(const NdbcRow& row, const std::string& name, sea::BuoySpectrum& spectrum) {
  const std::vector<double> width_hz = NdbcBandWidths(row.frequency_hz);
  double m0 = 0.0;
  for (std::size_t i = 0; i < row.value.size(); ++i) {
    if (IsMissing(row.value[i])) continue;
    if (!(row.value[i] >= 0.0F)) {
      return BadField(name, row.line, "density", absl::StrFormat("%g", row.value[i]),
                      absl::StrFormat(">= 0 (at %g Hz)", row.frequency_hz[i]));
    }
    spectrum.frequency_hz.push_back(row.frequency_hz[i]);
    spectrum.density_m2_per_hz.push_back(row.value[i]);
    m0 += row.value[i] * width_hz[i];
  }
  spectrum.hs_m = 4.0 * std::sqrt(m0);
  if (m0 > 0.0 && spectrum.frequency_hz.size() < 2) {
    return FileError(name, row.line, "density", "a spectrum needs at least 2 bands");
  }
  if (!(spectrum.hs_m <= kHsMaxM)) {
    return FileError(name, row.line, "density",
                     absl::StrFormat("gives Hs %.1f m; the limit is %g m", spectrum.hs_m, kHsMaxM));
  }
  return absl::OkStatus();
}

}  // namespace

std::vector<double> NdbcBandWidths(std::span<const float> frequency_hz) {
  const std::size_t n = frequency_hz.size();
  std::vector<double> width(n, 0.01);
  bool has_narrow_bands = false;
  for (std::size_t i = 1; i < n; ++i) {
    const double step = static_cast<double>(frequency_hz[i]) - frequency_hz[i - 1];
    has_narrow_bands |= frequency_hz[i] < 0.096F && std::abs(step - 0.005) < 1e-5;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double f = frequency_hz[i];
    if (has_narrow_bands) {
      width[i] = f < 0.096 ? 0.005 : f < 0.357 ? 0.010 : 0.020;
    } else if (n > 1) {
      const double below = i > 0 ? f - frequency_hz[i - 1] : frequency_hz[1] - f;
      const double above = i + 1 < n ? frequency_hz[i + 1] - f : f - frequency_hz[n - 2];
      width[i] = 0.5 * (below + above);
    }
  }
  return width;
}

absl::StatusOr<std::vector<SpectrumRecord>> JoinNdbcTables(const NdbcTables& tables,
                                                           const std::string& place) {
  DirectionalRows rows{RowAtTime(tables.mean_direction), RowAtTime(tables.principal_direction),
                       RowAtTime(tables.r1), RowAtTime(tables.r2), tables.is_history ? 0.01 : 1.0};
  std::vector<SpectrumRecord> records;
  for (const NdbcRow& row : tables.density.rows) {
    sea::BuoySpectrum spectrum;
    ONESEA_RETURN_IF_ERROR(ReadDensity(row, tables.density.name, spectrum));
    if (!(spectrum.hs_m > 0.0)) continue;
    ONESEA_RETURN_IF_ERROR(AddDirections(row.time_utc, rows, spectrum));
    SpectrumRecord record;
    record.time_utc = row.time_utc;
    record.place = place;
    record.format = absl::StrCat("NDBC ", tables.is_history ? "historical" : "real-time",
                                 spectrum.r1.empty() ? ", 1-D" : ", directional");
    record.system = std::move(spectrum);
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace onesea::ingest
