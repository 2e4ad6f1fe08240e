// The optics of shaders/optics.glsl, run on the graphics card, against independent answers.
#include <cmath>
#include <string>

#include "client/render/shader_program.h"
#include "client/render/water_optics.h"
#include "tests/render/gl_fixture.h"

namespace onesea::render {
namespace {

class OpticsTest : public GlTest {
 protected:
  // Evaluates `expression` of `x` (the pixel's centre, 0.5/n ...) for n pixels.
  std::vector<float> Evaluate(const std::string& expression, int n) {
    const std::string head = "#version 330 core\nconst float kPi = 3.14159265;\n" +
                             std::string(EmbeddedShader("optics.glsl"));
    auto program = ShaderProgram::BuildText(
        "#version 330 core\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, "
        "gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }",
        head + "out vec4 result; void main() { float x = gl_FragCoord.x / " + std::to_string(n) +
            ".0; result = vec4(" + expression + "); }");
    EXPECT_TRUE(program.ok()) << program.status().message();
    Texture texture;
    Framebuffer framebuffer;
    VertexArray empty;
    BindTexture(0, GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, n, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    glViewport(0, 0, n, 1);
    program->Use();
    glBindVertexArray(empty.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<float> pixels(static_cast<std::size_t>(n));
    glReadPixels(0, 0, n, 1, GL_RED, GL_FLOAT, pixels.data());
    return pixels;
  }
};

// Own table of the Fresnel equations for n = 1.34, computed in double: degrees, reflectance.
TEST_F(OpticsTest, FresnelIsExact) {
  constexpr double kTable[][2] = {{0, 0.02111184},  {20, 0.02129826}, {45, 0.02878228},
                                  {60, 0.06100485}, {70, 0.13536061}, {80, 0.35019989},
                                  {85, 0.58532887}, {89, 0.89679612}};
  for (const auto& [degrees, expected] : kTable) {
    const double cosine = std::cos(degrees * M_PI / 180.0);
    const float got = Evaluate("fresnel_exact(" + std::to_string(cosine) + ")", 1)[0];
    // Amplitudes, by Snell's law, the other way round than the shader's closed form.
    const double sine_t = std::sin(degrees * M_PI / 180.0) / 1.34,
                 cosine_t = std::sqrt(1 - sine_t * sine_t);
    const double s = (cosine - 1.34 * cosine_t) / (cosine + 1.34 * cosine_t);
    const double p = (1.34 * cosine - cosine_t) / (1.34 * cosine + cosine_t);
    EXPECT_NEAR(got, 0.5 * (s * s + p * p), 2e-5) << degrees;
    EXPECT_NEAR(got, expected, 2e-5) << degrees;
  }
}

TEST_F(OpticsTest, MeanFresnelOfAFlatSeaIsExact) {
  const std::vector<float> mean = Evaluate("fresnel_mean(x, 0.0)", 64),
                           exact = Evaluate("fresnel_exact(x)", 64);
  for (std::size_t n = 0; n < mean.size(); ++n) EXPECT_NEAR(mean[n], exact[n], 1e-5);
}

// A rough sea reflects far less at grazing than a mirror: 0.30 against 0.72 at 87 degrees for a
// slope deviation of 0.2 (Bruneton, Neyret & Holzschuch 2010).
TEST_F(OpticsTest, MeanFresnelFallsWithRoughness) {
  const std::string cosine = std::to_string(std::cos(87.0 * M_PI / 180.0));
  const float flat = Evaluate("fresnel_mean(" + cosine + ", 0.0)", 1)[0];
  const float rough = Evaluate("fresnel_mean(" + cosine + ", 0.2)", 1)[0];
  EXPECT_NEAR(flat, 0.72f, 0.02f);
  EXPECT_NEAR(rough, 0.30f, 0.03f);
}

// Visible area and mean visible slope against brute-force integration over the Gaussian.
TEST_F(OpticsTest, VisibleFacetsMatchIntegration) {
  for (double view : {0.02, 0.1, 0.4, 1.2}) {  // elevation of the eye
    for (double deviation : {0.05, 0.15, 0.3}) {
      const double vx = std::cos(view), vz = std::sin(view), mean = 0.08;
      double area = 0.0, slope = 0.0;
      const double step = deviation / 400.0;
      for (double t = mean - 8 * deviation; t < mean + 8 * deviation; t += step) {
        const double weight = std::exp(-0.5 * std::pow((t - mean) / deviation, 2)) /
                              (deviation * std::sqrt(2 * M_PI)) * step;
        const double seen = std::max(0.0, vz - t * vx);
        area += weight * seen;
        slope += weight * seen * t;
      }
      slope /= area;
      const std::string facets = "visible_facets(vec2(0.08, 0.0), vec3(" +
                                 std::to_string(deviation * deviation) + ", 0.01, 0.0), vec3(" +
                                 std::to_string(vx) + ", 0.0, " + std::to_string(vz) + "))";
      EXPECT_NEAR(Evaluate(facets + ".area", 1)[0], area, 2e-3 * area + 1e-5)
          << view << " " << deviation;
      EXPECT_NEAR(Evaluate(facets + ".slope.x", 1)[0], slope, 5e-3) << view << " " << deviation;
    }
  }
}

TEST_F(OpticsTest, ShareBelowIsTheNormalDistribution) {
  for (double z : {-2.5, -1.0, 0.0, 0.7, 2.0}) {
    const float got =
        Evaluate("share_below(" + std::to_string(1.0 + 0.2 * z) + ", 1.0, 0.2)", 1)[0];
    EXPECT_NEAR(got, 0.5 * std::erfc(-z / std::sqrt(2.0)), 5e-5) << z;
  }
}

// R = 0.33 b_b / a and a = 0.9 Kd (1 - 2.25 R) tie the table's columns together.
TEST(WaterOptics, TableIsConsistent) {
  for (int type = 0; type <= static_cast<int>(WaterType::k5C); ++type) {
    const WaterOptics& optics = OpticsOf(static_cast<WaterType>(type));
    for (int c = 0; c < 3; ++c) {
      const float expected = 0.9f * optics.kd[c] * (1.0f - 2.25f * optics.reflectance[c]);
      EXPECT_NEAR(optics.absorption[c] / expected, 1.0f, 0.06f) << type << " " << c;
    }
  }
}

}  // namespace
}  // namespace onesea::render
