#include "server/world/radiation_memory.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

constexpr int kKernelStepsMax = 4096;

}  // namespace

double RadiationKernel::Force(std::span<const double> history_m_per_s) const {
  // history[0] is the velocity one step ago.
  double sum = 0.0;
  const std::size_t count = std::min(history_m_per_s.size(), kernel.size() - 1);
  for (std::size_t n = 0; n < count; ++n) sum += kernel[n + 1] * history_m_per_s[n];
  return -step_s * sum;
}

absl::Status MakeRadiationKernel(std::span<const double> omega_rad_per_s,
                                 std::span<const double> damping_kg_per_s, double step_s,
                                 double length_s, RadiationKernel& kernel) {
  const std::size_t count = omega_rad_per_s.size();
  if (count < 2 || damping_kg_per_s.size() != count) {
    return absl::InvalidArgumentError(absl::StrCat("radiation table: ", count, " frequencies and ",
                                                   damping_kg_per_s.size(),
                                                   " dampings; at least 2 of each"));
  }
  for (std::size_t n = 0; n < count; ++n) {
    const double before = n > 0 ? omega_rad_per_s[n - 1] : 0.0;
    if (!(omega_rad_per_s[n] > before) || !(omega_rad_per_s[n] < 1e6) ||
        !(damping_kg_per_s[n] >= 0.0) || !(damping_kg_per_s[n] < 1e15)) {
      return absl::InvalidArgumentError(absl::StrCat(
          "radiation table row ", n, ": ", omega_rad_per_s[n], ", ", damping_kg_per_s[n]));
    }
  }
  if (!(step_s > 0.0) || !(length_s >= step_s) || !(length_s <= kKernelStepsMax * step_s)) {
    return absl::InvalidArgumentError(absl::StrCat("radiation kernel of ", length_s,
                                                   " s in steps of ", step_s, " s: 1 to ",
                                                   kKernelStepsMax, " steps"));
  }
  kernel.step_s = step_s;
  kernel.kernel.clear();
  for (double s = 0.0; s <= length_s; s += step_s) {
    double sum = 0.0;
    double w0 = 0.0, f0 = 0.0;
    const auto add = [&](double w, double damping) {
      const double f = damping * real::Cos(w * s);
      sum += 0.5 * (w - w0) * (f + f0);
      w0 = w;
      f0 = f;
    };
    for (std::size_t n = 0; n < count; ++n) add(omega_rad_per_s[n], damping_kg_per_s[n]);
    // The tail, in steps of the table's last.
    const double last = omega_rad_per_s[count - 1];
    const double step = last - omega_rad_per_s[count - 2];
    for (double w = last + step; w < 4.0 * last; w += step) {
      add(w, damping_kg_per_s[count - 1] * (last / w) * (last / w) * (last / w));
    }
    kernel.kernel.push_back(2.0 / sea::kPi * sum);
  }
  return absl::OkStatus();
}

}  // namespace onesea::world
