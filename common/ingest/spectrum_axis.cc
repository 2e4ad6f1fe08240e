#include "common/ingest/spectrum_axis.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace onesea::ingest {

absl::Status AppendFrequency(const TextLines& lines, double hz, std::vector<float>& frequency_hz) {
  if (!(hz >= kFrequencyMinHz && hz <= kFrequencyMaxHz)) {
    return lines.Error("frequency", absl::StrFormat("%g Hz is not in [%.4f, %g]", hz,
                                                    kFrequencyMinHz, kFrequencyMaxHz));
  }
  if (frequency_hz.size() == static_cast<std::size_t>(kSpectrumFrequenciesMax)) {
    return lines.Error("frequency", absl::StrCat("more than ", kSpectrumFrequenciesMax));
  }
  const float value = static_cast<float>(hz);
  if (!frequency_hz.empty() && !(value > frequency_hz.back())) {
    return lines.Error("frequency", absl::StrFormat("%g Hz is not above the one before it", hz));
  }
  frequency_hz.push_back(value);
  return absl::OkStatus();
}

}  // namespace onesea::ingest
