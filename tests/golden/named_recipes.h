#pragma once

#include <string>
#include <vector>

#include "common/sea/recipe.h"

/// Recipes with names, for golden hashes and benchmarks. Made without libm, so that the recipe
/// itself has the same bits everywhere.
namespace onesea::sea {

struct NamedRecipe {
  std::string name;
  Recipe recipe;
};

/// Every family of spectra, spreading and option of a recipe occurs in at least one of them.
std::vector<NamedRecipe> NamedRecipes();

}  // namespace onesea::sea
