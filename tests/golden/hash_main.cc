// Prints "recipe stage hash", one line per stage, the same text on every machine. Two outputs that
// differ tell by their first different line which stage broke (docs/determinism.md).

#include <bit>
#include <cinttypes>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/base/fp_env.h"
#include "common/base/hash.h"
#include "common/base/real_math.h"
#include "common/base/rng.h"
#include "common/sea/components.h"
#include "common/sea/point_query.h"
#include "common/sea/surface.h"
#include "hwy/targets.h"
#include "tests/golden/named_recipes.h"

namespace onesea::sea {
namespace {

void Print(const std::string& recipe, const std::string& stage, std::uint64_t hash) {
  std::printf("%s %s %016" PRIx64 "\n", recipe.c_str(), stage.c_str(), hash);
}

void AddNumber(Hash64& hash, double value) {
  hash.Add(value == value ? value : 1e300);  // a NaN's bits are nobody's promise
}

void PrintRealMath() {
  Hash64 hash;
  for (std::uint32_t n = 0; n < 20000; ++n) {
    const auto w = Philox4x32({n, 0, 0, 0}, {1, 2});
    const double any = std::bit_cast<double>((std::uint64_t{w[0]} << 32) | w[1]);
    const double near = 40.0 * (UnitInterval(w[2], w[3]) - 0.5);
    for (const double x : {any, near}) {
      for (const double value :
           {real::Exp(x), real::Log(x), real::Sin(x), real::Cos(x), real::Sinh(x), real::Tanh(x),
            real::Atan2(x, near), real::Pow(near > 0 ? near : -near, x), real::Pow(x, near)}) {
        AddNumber(hash, value);
      }
    }
  }
  Print("-", "real_math", hash.value());
}

void PrintCascade(const std::string& name, std::size_t c, const CascadeComponents& cascade) {
  Hash64 waves;
  for (const std::uint64_t turns : cascade.turns_per_flick) waves.Add(turns);
  for (const std::uint32_t turns : cascade.phase_turns) waves.Add(turns);
  for (const float k : cascade.kx_rad_per_m) waves.Add(k);
  for (const float k : cascade.ky_rad_per_m) waves.Add(k);
  Print(name, "waves" + std::to_string(c), waves.value());
  for (std::size_t m = 0; m < cascade.variance_m2.size(); ++m) {
    Hash64 variance;
    for (const float v : cascade.variance_m2[m]) variance.Add(v);
    Print(name, "variance" + std::to_string(c) + "." + std::to_string(m), variance.value());
  }
}

// All eleven fields of one cascade at one time.
std::uint64_t SurfaceHash(const std::shared_ptr<const Components>& components, int cascade,
                          int grid_size) {
  constexpr FieldSet kAll = (FieldSet{1} << kFieldCount) - 1;
  Synthesiser synthesiser(components, cascade, grid_size, kAll);
  CascadeFields fields(grid_size, kAll);
  synthesiser.Evaluate(SimTime::FromSeconds(12345.678), fields);
  Hash64 hash;
  for (int field = 0; field < kFieldCount; ++field) {
    for (const float value : fields.Plane(static_cast<Field>(field))) hash.Add(value);
  }
  return hash.value();
}

// Answers to a thousand queries, normals and velocities included.
std::uint64_t QueryHash(const std::shared_ptr<const Components>& components) {
  SnapshotBuilder builder(components);
  const auto snapshot = builder.At(SimTime::FromSeconds(-98.7), QueryDetail::kVelocity);
  std::vector<Vec2d> points;
  for (std::uint32_t n = 0; n < 1000; ++n) {
    const auto w = Philox4x32({n, 7, 0, 0}, {1, 2});
    points.push_back({5000.0 * UnitInterval(w[0], w[1]), -9000.0 * UnitInterval(w[2], w[3])});
  }
  std::vector<SurfaceSample> answers(points.size());
  snapshot->Sample(points, answers);
  Hash64 hash;
  for (const SurfaceSample& a : answers) {
    for (const float value :
         {a.height_m, a.displacement_x_m, a.displacement_y_m, a.residual_m, a.normal_x, a.normal_y,
          a.normal_z, a.velocity_x_m_per_s, a.velocity_y_m_per_s, a.velocity_z_m_per_s}) {
      hash.Add(value);
    }
    hash.Add(static_cast<int>(a.folded));
  }
  return hash.value();
}

// One line; with a second one for every SIMD target of this machine that gives other bits.
template <typename Function>
void PrintForEveryTarget(const std::string& recipe, const std::string& stage, Function function) {
  const std::uint64_t best = function();
  Print(recipe, stage, best);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const std::uint64_t hash = function();
    if (hash != best) Print(recipe, stage + "." + hwy::TargetName(target), hash);
  }
  hwy::SetSupportedTargetsForTest(0);
}

// Everything that is promised to be equal about one recipe; add further stages below.
bool PrintRecipe(const NamedRecipe& named) {
  const auto components = BuildComponents(named.recipe);
  if (!components.ok()) {
    std::fprintf(stderr, "%s: %s\n", named.name.c_str(), components.status().ToString().c_str());
    return false;
  }
  for (std::size_t c = 0; c < (*components)->cascades.size(); ++c) {
    PrintCascade(named.name, c, (*components)->cascades[c]);
  }
  Print(named.name, "components", (*components)->hash);
  for (std::size_t c = 0; c < (*components)->cascades.size(); ++c) {
    PrintForEveryTarget(named.name, "surface" + std::to_string(c) + ".128",
                        [&] { return SurfaceHash(*components, static_cast<int>(c), 128); });
  }
  PrintForEveryTarget(named.name, "query", [&] { return QueryHash(*components); });
  return true;
}

int Main() {
  if (const absl::Status status = CheckFpEnvironment(); !status.ok()) {
    std::fprintf(stderr, "%s\n", status.ToString().c_str());
    return 1;
  }
  PrintRealMath();
  for (const NamedRecipe& named : NamedRecipes()) {
    if (!PrintRecipe(named)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace onesea::sea

int main() { return onesea::sea::Main(); }
