#include "client/render/foam_texture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace onesea::render {
namespace {

std::uint32_t Mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

float Random(int x, int y, std::uint32_t salt) {
  const std::uint32_t bits =
      Mix(static_cast<std::uint32_t>(x) * 0x9e3779b9U ^ Mix(static_cast<std::uint32_t>(y) + salt));
  return static_cast<float>(bits >> 8) * (1.0f / 16777216.0f);
}

int Wrap(int i, int n) { return ((i % n) + n) % n; }

// Distance to the nearest cell wall, F2 - F1, in cells; periodic over `cells`.
float WorleyWall(float x, float y, int cells, std::uint32_t salt) {
  const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
  float first = 9.0f, second = 9.0f;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int wx = Wrap(cx + i, cells), wy = Wrap(cy + j, cells);
      const float px = static_cast<float>(cx + i) + Random(wx, wy, salt) - x;
      const float py = static_cast<float>(cy + j) + Random(wx, wy, salt + 77) - y;
      const float distance = std::sqrt(px * px + py * py);
      second = std::min(second, std::max(first, distance));
      first = std::min(first, distance);
    }
  }
  return second - first;
}

// Smooth value noise, periodic over `cells`.
float ValueNoise(float x, float y, int cells, std::uint32_t salt) {
  const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
  const auto fade = [](float t) { return t * t * t * (t * (6.0f * t - 15.0f) + 10.0f); };
  const float fx = fade(x - static_cast<float>(cx)), fy = fade(y - static_cast<float>(cy));
  const auto corner = [&](int i, int j) {
    return Random(Wrap(cx + i, cells), Wrap(cy + j, cells), salt);
  };
  const float low = std::lerp(corner(0, 0), corner(1, 0), fx);
  const float high = std::lerp(corner(0, 1), corner(1, 1), fx);
  return std::lerp(low, high, fy);
}

float Fractal(float u, float v, int cells, int octaves, std::uint32_t salt) {
  float sum = 0.0f, weight = 0.5f;
  for (int octave = 0; octave < octaves; ++octave, cells *= 2, weight *= 0.52f) {
    sum += weight * ValueNoise(u * static_cast<float>(cells), v * static_cast<float>(cells), cells,
                               salt + 131U * static_cast<std::uint32_t>(octave));
  }
  return sum;
}

// Replaces each value by its rank.
std::vector<std::uint8_t> Equalise(const std::vector<float>& values) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return values[a] < values[b]; });
  std::vector<std::uint8_t> ranks(values.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    ranks[order[n]] = static_cast<std::uint8_t>(n * 256 / order.size());
  }
  return ranks;
}

}  // namespace

std::vector<std::uint8_t> MakeFoamTexture() {
  struct Scale {
    int cells;
    float weight;
  };
  constexpr Scale kScales[] = {{64, 0.25f}, {18, 0.38f}, {5, 0.37f}};
  std::vector<float> values(static_cast<std::size_t>(kFoamTextureSize) * kFoamTextureSize);
  for (int y = 0; y < kFoamTextureSize; ++y) {
    for (int x = 0; x < kFoamTextureSize; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / kFoamTextureSize;
      const float v = (static_cast<float>(y) + 0.5f) / kFoamTextureSize;
      float value = 0.0f;
      for (const Scale& scale : kScales) {
        const float cells = static_cast<float>(scale.cells);
        // The warp bends straight Voronoi walls into drawn-out films.
        const float warp_x = Fractal(u, v, scale.cells, 2, 11) - 0.37f;
        const float warp_y = Fractal(u, v, scale.cells, 2, 23) - 0.37f;
        const float wall = WorleyWall(u * cells + 0.9f * warp_x, v * cells + 0.9f * warp_y,
                                      scale.cells, 1000U * static_cast<std::uint32_t>(scale.cells));
        value += scale.weight * std::exp(-4.5f * wall);
      }
      value += 0.25f * Fractal(u, v, 4, 5, 5);
      values[static_cast<std::size_t>(y * kFoamTextureSize + x)] = value;
    }
  }
  return Equalise(values);
}

std::vector<std::uint8_t> MakeCloudTexture(int size) {
  std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
      const float wx = u + 0.06f * Fractal(u, v, 6, 4, 401),
                  wy = v + 0.06f * Fractal(u, v, 6, 4, 733);
      const float soft = Fractal(wx, wy, 5, 7, 9);
      const float billow = std::abs(2.0f * Fractal(wx, wy, 12, 5, 91) - 0.95f);
      values[static_cast<std::size_t>(y * size + x)] = soft - 0.22f * billow;
    }
  }
  return Equalise(values);
}

}  // namespace onesea::render
