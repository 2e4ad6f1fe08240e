#include "server/world/wave_solver.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace onesea::world {
namespace {

std::string Refusal(auto change) {
  SolverSpec spec;
  spec.cells = {.columns = 128, .rows = 96};
  EXPECT_TRUE(ValidateSolverSpec(spec).ok());
  change(spec);
  return std::string(ValidateSolverSpec(spec).message());
}

TEST(SolverSpec, ErrorsNameTheField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto named = [](const std::string& message, const char* field) {
    return message.find(field) != std::string::npos;
  };
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.cells.columns = 32; }), "region.columns"));
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.cells.rows = 4096; }), "region.rows"));
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.cells.rows = 100; }), "multiples of 32"));
  EXPECT_TRUE(named(Refusal([&](SolverSpec& s) { s.cells.cell_m = nan; }), "region.cell_m"));
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.step_s = 0; }), "region.step_s"));
  EXPECT_TRUE(named(Refusal([&](SolverSpec& s) { s.depth_m = nan; }), "region.depth_m"));
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.damping_per_s = -1; }), "region.damping_per_s"));
  EXPECT_TRUE(named(Refusal([](SolverSpec& s) { s.edge_cells = 49; }), "region.edge_cells"));
}

}  // namespace
}  // namespace onesea::world
