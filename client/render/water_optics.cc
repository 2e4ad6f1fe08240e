#include "client/render/water_optics.h"

#include <array>

namespace onesea::render {

const WaterOptics& OpticsOf(WaterType type) {
  static const std::array<WaterOptics, 7> kTable = {{
      {{.27f, .061f, .018f}, {.24f, .054f, .014f}, {.0012f, .0079f, .057f}},  // I
      {{.27f, .068f, .035f}, {.25f, .060f, .029f}, {.0017f, .0093f, .033f}},  // IB
      {{.29f, .086f, .066f}, {.26f, .076f, .056f}, {.0026f, .011f, .023f}},   // II
      {{.33f, .12f, .13f}, {.29f, .10f, .11f}, {.0035f, .012f, .015f}},       // III
      {{.33f, .12f, .22f}, {.29f, .10f, .19f}, {.011f, .033f, .021f}},        // 1C
      {{.36f, .19f, .35f}, {.31f, .16f, .30f}, {.019f, .040f, .024f}},        // 3C
      {{.43f, .30f, .51f}, {.36f, .24f, .42f}, {.032f, .051f, .032f}},        // 5C
  }};
  return kTable[static_cast<std::size_t>(type)];
}

glm::vec3 WaterLeavingRadiance(const WaterOptics& optics, const glm::vec3& irradiance) {
  return irradiance * optics.reflectance * (0.54f / 4.0f);
}

glm::vec3 BubblyReflectance(const WaterOptics& optics, float bubbles_per_m) {
  return optics.reflectance +
         0.33f * bubbles_per_m / (optics.absorption + glm::vec3(bubbles_per_m));
}

}  // namespace onesea::render
