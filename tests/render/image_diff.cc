#include "tests/render/image_diff.h"

#include <png.h>

#include <cmath>

namespace onesea::render {
namespace {

constexpr int kBlock = 8;

double Luma(const Picture& picture, int x, int y) {
  const std::uint8_t* p = &picture.rgb[static_cast<std::size_t>((y * picture.width + x) * 3)];
  return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

double BlockSsim(const Picture& a, const Picture& b, int left, int top) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + kBlock; ++y) {
    for (int x = left; x < left + kBlock; ++x) {
      const double la = Luma(a, x, y), lb = Luma(b, x, y);
      sum_a += la;
      sum_b += lb;
      aa += la * la;
      bb += lb * lb;
      ab += la * lb;
    }
  }
  constexpr double kCount = kBlock * kBlock, kC1 = 6.5025, kC2 = 58.5225;
  const double mean_a = sum_a / kCount, mean_b = sum_b / kCount;
  const double var_a = aa / kCount - mean_a * mean_a, var_b = bb / kCount - mean_b * mean_b;
  const double covariance = ab / kCount - mean_a * mean_b;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

}  // namespace

Likeness Compare(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return {255.0, 0.0};
  double squares = 0.0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n) {
    const double difference = static_cast<double>(a.rgb[n]) - b.rgb[n];
    squares += difference * difference;
  }
  double ssim = 0.0;
  int blocks = 0;
  for (int y = 0; y + kBlock <= a.height; y += kBlock) {
    for (int x = 0; x + kBlock <= a.width; x += kBlock, ++blocks) ssim += BlockSsim(a, b, x, y);
  }
  return {std::sqrt(squares / static_cast<double>(a.rgb.size())), ssim / blocks};
}

Picture ReadPng(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height),
                  std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) return {};
  return picture;
}

}  // namespace onesea::render
