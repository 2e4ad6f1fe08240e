// A laid rope in sun and sky light, cut off where the sea, land or a hull stands before it.
uniform sampler2DMS hull_depth;
uniform int hulls;  // 0: there is no hull_depth
in vec3 offset_eye;
in vec3 side;
in vec3 tangent;
in vec3 across_along;
in vec2 half_faint;
in float depth;
out vec4 radiance;

const vec3 kRope = vec3(0.42, 0.36, 0.24);
const float kStrandsPerRadius = 0.30;  // along the rope

// Share of the pixel's hull samples that stand farther off.
float before_hulls() {
  if (hulls == 0) return 1.0;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float share = 0.0;
  for (int n = 0; n < 4; ++n) {
    float there = texelFetch(hull_depth, pixel, n).r;
    float hull = there < 0.5 ? 0.5 * kNearest / (0.5 - there) : 1e6;
    // A rope lies on the deck, and far off the depth is coarse.
    share += depth < hull + 0.03 + 1e-6 * depth * depth ? 0.25 : 0.0;
  }
  return share;
}

void main() {
  float distance = length(offset_eye);
  float cover = clamp(half_faint.x - abs(across_along.x) + 0.5, 0.0, 1.0) * half_faint.y;
  cover *= before_sea(distance, depth, offset_eye.z) * before_hulls();
  if (cover < 0.003) discard;

  vec3 direction = offset_eye / distance;
  float across = clamp(across_along.x / half_faint.x, -0.98, 0.98);
  vec3 facing = normalize(cross(side, tangent));
  if (dot(facing, direction) > 0.0) facing = -facing;
  vec3 n = normalize(side) * across + facing * sqrt(1.0 - across * across);
  // Its strands run round it; from afar they are one.
  float strand = fract(across_along.y / across_along.z * kStrandsPerRadius + 0.35 * across);
  float seen = clamp(half_faint.x * 0.5 - 1.0, 0.0, 1.0);
  float groove = mix(1.0, 0.55 + 0.6 * sin(kPi * strand), seen);

  vec3 below = kPi * water_leaving.rgb + 0.07 * sky_irradiance.rgb;
  float up = 0.5 + 0.5 * n.z;
  vec3 light = mix(below, 0.85 * sky_irradiance.rgb, up * up * (3.0 - 2.0 * up));
  light += sun_irradiance.rgb * max(dot(n, sun_direction.xyz), 0.0);
  vec3 colour = kRope * groove / kPi * light;
  colour = eye.z < 0.0 ? mix(water_body(direction), colour, water_passed(distance))
                       : through_air(colour, direction, distance);
  radiance = vec4(colour * cover, cover);
}
