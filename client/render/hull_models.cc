#include "client/render/hull_models.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/render/hull_painter.h"
#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Paint kTopside{{1.0f, 1.0f, 1.0f}, 0.75f, 1.0f};
constexpr Paint kWhite{{0.72f, 0.72f, 0.69f}, 0.55f, 0.0f};
constexpr Paint kDeck{{0.50f, 0.46f, 0.38f}, 0.08f, 0.0f};
constexpr Paint kBottom{{0.09f, 0.025f, 0.02f}, 0.12f, 0.0f};
constexpr Paint kRubber{{0.025f, 0.025f, 0.028f}, 0.2f, 0.0f};
constexpr Paint kWindow{{0.012f, 0.016f, 0.02f}, 0.97f, 0.0f};
constexpr Paint kMotor{{0.035f, 0.037f, 0.042f}, 0.6f, 0.0f};
constexpr Paint kSteel{{0.35f, 0.36f, 0.37f}, 0.5f, 0.0f};
constexpr Paint kWood{{0.22f, 0.135f, 0.07f}, 0.1f, 0.0f};
constexpr Paint kWoodPale{{0.30f, 0.20f, 0.115f}, 0.1f, 0.0f};
constexpr Paint kWoodDark{{0.15f, 0.085f, 0.045f}, 0.08f, 0.0f};
constexpr Paint kGap{{0.02f, 0.013f, 0.009f}, 0.0f, 0.0f};
constexpr Paint kRope{{0.42f, 0.36f, 0.24f}, 0.02f, 0.0f};

SharedHullMesh Share(HullMesh mesh) { return std::make_shared<const HullMesh>(std::move(mesh)); }

// One cross-section of the boat, starboard, from the keel to the deck's edge.
struct Section {
  Vec3d keel, paint, chine, waterline, sheer, deck;
};

// The lines of a hard-chine boat: the bow begins amidships, rises and rakes.
Section SectionAt(double along, double length, double beam, double depth) {
  constexpr double kBowBegins = 0.45, kDeadriseTangent = 0.3093, kTransomShare = 0.85;
  const double fore = std::max(0.0, (along - kBowBegins) / (1.0 - kBowBegins));
  const double aft = std::max(0.0, 1.0 - along / kBowBegins);
  const double half = 0.5 * beam * (1.0 - fore * fore) * (1.0 - (1.0 - kTransomShare) * aft * aft);
  const double keel_z = 0.75 * depth * fore * fore * fore;
  const double chine_half = 0.85 * half;
  const double chine_z =
      keel_z + std::min(chine_half * kDeadriseTangent + 0.5 * (depth - keel_z) * fore,
                        0.8 * (depth - keel_z));
  const double rake = 0.12 * length * fore * fore;
  // Points on the straight side between chine and deck, `up` of the way.
  const auto side = [&](double up) {
    const double z = chine_z + up * (depth - chine_z);
    return Vec3d{(along - 0.5) * length - rake * (1.0 - z / depth),
                 -(chine_half + up * (half - chine_half)), z};
  };
  const Vec3d keel{(along - 0.5) * length - rake * (1.0 - keel_z / depth), 0.0, keel_z};
  // The bottom's paint ends at one height, on the bottom itself where the bow rises.
  const double paint_z = 0.56 * depth, bottom = chine_z - keel_z;
  const double up = std::clamp((paint_z - chine_z) / (depth - chine_z), 0.0, 0.8);
  const double along_bottom =
      bottom > 0.0 ? std::clamp((paint_z - keel_z) / bottom, 0.0, 1.0) : 0.0;
  const Vec3d chine = side(0.0);
  return {keel, keel + along_bottom * (chine - keel), chine, side(up), side(0.86), side(1.0)};
}

Vec3d Mirror(Vec3d p) { return {p.x, -p.y, p.z}; }

// A strip of the hull between two lines of two sections, and its mirror image.
void Strip(HullPainter& painter, Vec3d low_aft, Vec3d low_fore, Vec3d high_fore, Vec3d high_aft,
           const Paint& paint) {
  painter.Quad(low_aft, low_fore, high_fore, high_aft, paint);
  painter.Quad(Mirror(high_aft), Mirror(high_fore), Mirror(low_fore), Mirror(low_aft), paint);
}

void PaintShell(HullPainter& painter, double length, double beam, double depth) {
  constexpr int kStations = 17;
  const double wall = std::max(0.03, 0.035 * beam), rise = 0.24 * depth;
  // The bulwark stands on the deck's edge and leans out a little; it ends short of the stem's tip.
  const auto top_of = [&](const Section& s) {
    return Vec3d{s.deck.x + 0.25 * rise * std::max(0.0, s.deck.x / length), 1.02 * s.deck.y,
                 s.deck.z + rise * (0.8 + 0.5 * std::max(0.0, s.deck.x / length))};
  };
  const auto inwards = [&](Vec3d p) {
    return Vec3d{p.x - wall * std::max(0.0, p.x / length), std::min(0.0, p.y + wall), p.z};
  };
  for (int n = 0; n + 1 < kStations; ++n) {
    const Section a = SectionAt(static_cast<double>(n) / (kStations - 1), length, beam, depth);
    const Section b = SectionAt(static_cast<double>(n + 1) / (kStations - 1), length, beam, depth);
    Strip(painter, a.keel, b.keel, b.paint, a.paint, kBottom);
    Strip(painter, a.paint, b.paint, b.chine, a.chine, kTopside);
    Strip(painter, a.chine, b.chine, b.waterline, a.waterline, kBottom);
    Strip(painter, a.waterline, b.waterline, b.sheer, a.sheer, kTopside);
    Strip(painter, a.sheer, b.sheer, b.deck, a.deck, kRubber);
    const Vec3d ta = top_of(a), tb = top_of(b);
    Strip(painter, a.deck, b.deck, tb, ta, kTopside);
    Strip(painter, ta, tb, inwards(tb), inwards(ta), kWhite);
    Strip(painter, inwards(ta), inwards(tb), inwards(b.deck), inwards(a.deck), kWhite);
    painter.Quad(inwards(a.deck), inwards(b.deck), Mirror(inwards(b.deck)), Mirror(inwards(a.deck)),
                 kDeck);
    if (n > 0) continue;
    // The transom, seen from aft, and its bulwark's top and inner face.
    const auto aft = [&](Vec3d low, Vec3d high, const Paint& paint) {
      painter.Quad(low, high, Mirror(high), Mirror(low), paint);
    };
    aft(a.keel, a.paint, kBottom);
    aft(a.paint, a.chine, kTopside);
    aft(a.chine, a.waterline, kBottom);
    aft(a.waterline, a.sheer, kTopside);
    aft(a.sheer, a.deck, kRubber);
    aft(a.deck, ta, kTopside);
    const Vec3d back = ta + Vec3d{wall, 0, 0}, foot = a.deck + Vec3d{wall, 0, 0};
    painter.Quad(ta, back, Mirror(back), Mirror(ta), kWhite);
    painter.Quad(foot, Mirror(foot), Mirror(back), back, kWhite);
  }
}

void PaintWheelhouse(HullPainter& painter, double length, double beam, double depth) {
  const double half = 0.27 * beam, aft = -0.04 * length, front = 0.20 * length;
  const double sill = depth + 0.55 * depth, roof = depth + 1.15 * depth;
  const double rake = 0.07 * length, lean = 0.05 * beam;
  painter.Box({aft, -half, depth}, {front, half, sill}, kWhite);
  // The glass leans inwards on a sill; posts at its corners stand out from it.
  painter.Hood({aft + 0.02, -half + 0.02, sill}, {front - 0.02, half - 0.02, roof},
               {0.0, lean, rake}, kWindow);
  const double post = 0.016 * beam;
  for (double side : {-1.0, 1.0}) {
    const auto bar = [&](double x_low, double x_high) {
      painter.Bar({x_low, side * (half - 0.02), sill}, {x_high, side * (half - 0.02 - lean), roof},
                  post, 5, kWhite);
    };
    bar(front - 0.02, front - 0.02 - rake);
    bar(aft + 0.02, aft + 0.02);
    bar(0.45 * (aft + front), 0.45 * (aft + front) - 0.2 * rake);
  }
  painter.Hood({aft - 0.05 * length, -half, roof}, {front - 0.6 * rake, half, roof + 0.06 * depth},
               {0.03, 0.04, 0.06}, kWhite);
  painter.Bar({aft + 0.04 * length, 0, roof}, {aft + 0.02 * length, 0, roof + 0.8 * depth},
              0.008 * beam, 5, kSteel);
  // Foredeck hatch and a bench aft.
  painter.Hood({0.235 * length, -0.12 * beam, depth}, {0.31 * length, 0.12 * beam, 1.1 * depth},
               {0.02, 0.02, 0.02}, kWhite);
  painter.Box({-0.40 * length, -0.33 * beam, depth}, {-0.33 * length, 0.33 * beam, 1.22 * depth},
              kWoodPale);
}

void PaintMotor(HullPainter& painter, double length, double beam, double depth) {
  const double transom = -0.5 * length, size = std::min(0.16 * beam, 0.4);
  painter.Hood({transom - 1.5 * size, -0.5 * size, 1.05 * depth},
               {transom + 0.1 * size, 0.5 * size, 1.05 * depth + 1.5 * size},
               {0.25 * size, 0.12 * size, 0.35 * size}, kMotor);
  painter.Box({transom - 0.95 * size, -0.2 * size, -0.1 * depth},
              {transom - 0.35 * size, 0.2 * size, 1.06 * depth}, kMotor);
}

void PaintCrateFace(HullPainter& painter, Vec3d centre, Vec3d u, Vec3d v, Vec3d outwards) {
  // Four boards around and one across, each raised over the planks.
  const double raised = 0.02 * std::min(Norm(u), Norm(v)), width = 0.2;
  const auto board = [&](Vec2d low, Vec2d high, const Paint& paint) {
    const auto at = [&](double a, double b, double up) {
      return centre + a * u + b * v + up * raised * outwards;
    };
    const Vec3d foot[] = {at(low.x, low.y, 0), at(high.x, low.y, 0), at(high.x, high.y, 0),
                          at(low.x, high.y, 0)};
    const Vec3d top[] = {at(low.x, low.y, 1), at(high.x, low.y, 1), at(high.x, high.y, 1),
                         at(low.x, high.y, 1)};
    painter.Quad(top[0], top[1], top[2], top[3], paint);
    for (int n = 0; n < 4; ++n)
      painter.Quad(foot[n], foot[(n + 1) % 4], top[(n + 1) % 4], top[n], kWoodDark);
  };
  constexpr int kPlanks = 5;
  for (int n = 0; n < kPlanks; ++n) {
    const double low = -1.0 + 2.0 * n / kPlanks, high = low + 2.0 / kPlanks, gap = 0.025;
    const auto at = [&](double a, double b) { return centre + a * u + b * v; };
    painter.Quad(at(-1, low), at(1, low), at(1, low + gap), at(-1, low + gap), kGap);
    painter.Quad(at(-1, low + gap), at(1, low + gap), at(1, high), at(-1, high),
                 n % 2 == 0 ? kWood : kWoodDark);
  }
  board({-1, -1}, {1, -1 + width}, kWoodPale);
  board({-1, 1 - width}, {1, 1}, kWoodPale);
  board({-1, -1 + width}, {-1 + width, 1 - width}, kWood);
  board({1 - width, -1 + width}, {1, 1 - width}, kWood);
}

}  // namespace

SharedHullMesh BoatModel(double length, double beam, double depth) {
  ONESEA_CHECK(length > 0 && beam > 0 && depth > 0);
  HullPainter painter;
  PaintShell(painter, length, beam, depth);
  PaintWheelhouse(painter, length, beam, depth);
  PaintMotor(painter, length, beam, depth);
  return Share(painter.Finish(0.5));
}

SharedHullMesh BuoyModel(double radius, double height) {
  ONESEA_CHECK(radius > 0 && height > 0);
  const double r = radius, top = 0.5 * height;
  const Vec2d profile[] = {{0, -top},
                           {0.92 * r, -top},
                           {r, -0.85 * top},
                           {r, 0.85 * top},
                           {0.92 * r, top},
                           {0.42 * r, top + 0.1 * r},
                           {0.3 * r, top + r},
                           {0.24 * r, top + 1.5 * r},
                           {0.16 * r, top + 2.1 * r},
                           {0.2 * r, top + 2.12 * r},
                           {0.2 * r, top + 2.2 * r},
                           {0.09 * r, top + 2.22 * r},
                           {0.09 * r, top + 2.45 * r},
                           {0, top + 2.5 * r}};
  const Paint paints[] = {kBottom,  kBottom, kTopside, kTopside, kTopside, kTopside, kWhite,
                          kTopside, kRubber, kRubber,  kRubber,  kWindow,  kWindow};
  HullPainter painter;
  painter.Lathe(profile, paints, 28);
  for (int n = 0; n < 4; ++n) {  // lifting eyes
    const double a = 0.25 * kPi + 0.5 * kPi * n, c = std::cos(a), s = std::sin(a);
    painter.Bar({0.75 * r * c, 0.75 * r * s, top}, {0.75 * r * c, 0.75 * r * s, top + 0.22 * r},
                0.05 * r, 6, kSteel);
  }
  return Share(painter.Finish());
}

SharedHullMesh CrateModel(Vec3d size) {
  ONESEA_CHECK(size.x > 0 && size.y > 0 && size.z > 0);
  // The boards stand out by a fiftieth: the planks lie that much inside the body's faces.
  const Vec3d x{0.49 * size.x, 0, 0}, y{0, 0.49 * size.y, 0}, z{0, 0, 0.49 * size.z};
  HullPainter painter;
  const auto face = [&](Vec3d u, Vec3d v, Vec3d w) {
    PaintCrateFace(painter, w, u, v, (1.0 / Norm(w)) * w);
  };
  face(y, z, x);
  face(z, y, -1.0 * x);
  face(z, x, y);
  face(x, z, -1.0 * y);
  face(x, y, z);
  face(y, x, -1.0 * z);
  return Share(painter.Finish());
}

SharedHullMesh BarrelModel(double radius, double height) {
  ONESEA_CHECK(radius > 0 && height > 0);
  const double r = radius, h = 0.5 * height, rib = 0.035 * height;
  std::vector<Vec2d> profile = {
      {0, -0.97 * h}, {0.93 * r, -0.97 * h}, {0.95 * r, -h}, {r, -0.98 * h}};
  for (double middle : {-0.33 * h, 0.33 * h}) {
    for (const Vec2d& step : {Vec2d{0.965, -1.6}, {1.0, -0.5}, {1.0, 0.5}, {0.965, 1.6}}) {
      profile.push_back({step.x * r, middle + step.y * rib});
    }
  }
  for (const Vec2d& end :
       {Vec2d{r, 0.98 * h}, {0.95 * r, h}, {0.93 * r, 0.97 * h}, {0, 0.97 * h}}) {
    profile.push_back(end);
  }
  const Paint drum{{0.9f, 0.9f, 0.9f}, 0.45f, 1.0f};
  const std::vector<Paint> paints(profile.size() - 1, drum);
  HullPainter painter;
  painter.Lathe(profile, paints, 28);
  painter.Bar({0.55 * r, 0, 0.96 * h}, {0.55 * r, 0, 1.02 * h}, 0.12 * r, 8, kRubber);
  return Share(painter.Finish(0.5));
}

SharedHullMesh BallModel(double radius) {
  ONESEA_CHECK(radius > 0);
  constexpr int kRings = 20;
  std::vector<Vec2d> profile;
  std::vector<Paint> paints;
  for (int n = 0; n <= kRings; ++n) {
    const double angle = kPi * n / kRings;
    profile.push_back(
        {n % kRings == 0 ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle)});
    if (n < kRings) paints.push_back(n == kRings / 2 || n + 1 == kRings / 2 ? kWhite : kTopside);
  }
  HullPainter painter;
  painter.Lathe(profile, paints, 32);
  return Share(painter.Finish());
}

SharedHullMesh CapsuleModel(double radius, double length) {
  ONESEA_CHECK(radius > 0 && length > 0);
  constexpr int kRings = 9;  // of each end
  std::vector<Vec2d> profile;
  std::vector<Paint> paints;
  for (int n = 0; n <= 2 * kRings + 1; ++n) {
    const bool lower = n <= kRings;
    const double angle = 0.5 * kPi * (lower ? n : n - 1) / kRings;
    const bool tip = n == 0 || n == 2 * kRings + 1;
    profile.push_back({tip ? 0.0 : radius * std::sin(angle),
                       (lower ? -0.5 : 0.5) * length - radius * std::cos(angle)});
    // The last ring before the straight part, either side.
    if (n > 0) paints.push_back(n == kRings || n == kRings + 2 ? kWhite : kTopside);
  }
  HullPainter painter;
  painter.Lathe(profile, paints, 28);
  HullMesh mesh = painter.Finish();
  for (HullCorner& corner : mesh.corners) {  // z becomes x
    std::rotate(corner.position_m.begin(), corner.position_m.begin() + 2, corner.position_m.end());
    std::rotate(corner.normal.begin(), corner.normal.begin() + 2, corner.normal.end());
  }
  return Share(std::move(mesh));
}

SharedHullMesh RaftModel(Vec3d size) {
  ONESEA_CHECK(size.x > 0 && size.y > 0 && size.z > 0);
  HullPainter painter;
  const double radius = std::min(0.36 * size.z, 0.12 * size.y), deck = 0.5 * size.z - 0.12 * size.z;
  const int logs = std::max(2, static_cast<int>(size.y / (2.15 * radius)));
  for (int n = 0; n < logs; ++n) {
    const double y = (size.y - 2.0 * radius) * (static_cast<double>(n) / (logs - 1) - 0.5);
    const double reach = 0.5 * size.x * (n % 2 == 0 ? 1.0 : 0.97);
    painter.Bar({-reach, y, deck - radius}, {reach, y, deck - radius}, radius, 14,
                n % 3 == 1 ? kWood : kWoodDark);
  }
  const int planks = std::max(3, static_cast<int>(size.x / 0.3));
  for (int n = 0; n < planks; ++n) {
    const double low = 0.94 * size.x * (static_cast<double>(n) / planks - 0.5);
    const double wide = 0.94 * size.x / planks - 0.02, half = (n % 2 == 0 ? 0.5 : 0.49) * size.y;
    painter.Box({low, -half, deck}, {low + wide, half, 0.5 * size.z},
                n % 3 == 0 ? kWoodPale : kWood);
  }
  for (double x : {-0.35, 0.35}) {
    painter.Box({x * size.x - 0.03, -0.505 * size.y, deck - 0.3 * radius},
                {x * size.x + 0.03, 0.505 * size.y, 0.5 * size.z + 0.02}, kRope);
  }
  return Share(painter.Finish());
}

SharedHullMesh PlainModel(std::span<const Vec3d> vertices,
                          std::span<const std::array<std::uint32_t, 3>> triangles) {
  const Paint paint{{0.8f, 0.8f, 0.8f}, 0.4f, 1.0f};
  HullPainter painter;
  std::vector<std::uint32_t> index;
  for (const Vec3d& vertex : vertices) index.push_back(painter.Vertex(vertex));
  for (const auto& [a, b, c] : triangles) {
    ONESEA_CHECK(a < index.size() && b < index.size() && c < index.size());
    painter.Triangle(index[a], index[b], index[c], paint);
  }
  return Share(painter.Finish());
}

}  // namespace onesea::render
