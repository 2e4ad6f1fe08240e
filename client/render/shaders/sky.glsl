// Radiance of the sky. `sky_map`: x azimuth from the sun, y root of the elevation's sine,
// z blur; see client/render/sky_light.h.
uniform sampler3D sky_map;
// Its lowest row.
uniform sampler2D haze_map;

const vec3 kSkyMapSize = vec3(256.0, 96.0, 4.0);

// atan2 to 2e-4 rad, a third of the cost of the exact one.
float azimuth_of(vec2 xy) {
  vec2 a = abs(xy);
  float t = min(a.x, a.y) / max(max(a.x, a.y), 1e-12);
  float t2 = t * t;
  float angle = t * (0.99978784 + t2 * (-0.32580840 + t2 * (0.15557865 + t2 * -0.04432655)));
  angle = a.y > a.x ? 0.5 * kPi - angle : angle;
  angle = xy.x < 0.0 ? kPi - angle : angle;
  return xy.y < 0.0 ? -angle : angle;
}

vec3 sky_at(vec3 direction, float blur_rad) {
  float azimuth = azimuth_of(direction.xy) - sun_direction.w;
  float row = sqrt(max(direction.z, 0.004));
  // Inverse of the levels 0, 0.1, 0.25, 0.55 rad.
  float level = blur_rad < 0.1 ? blur_rad * 10.0
              : blur_rad < 0.25 ? 1.0 + (blur_rad - 0.1) / 0.15
                                : 2.0 + min((blur_rad - 0.25) / 0.3, 1.0);
  return texture(sky_map, vec3(azimuth / (2.0 * kPi) + 0.5 / kSkyMapSize.x,
                               (0.5 + row * (kSkyMapSize.y - 1.0)) / kSkyMapSize.y,
                               (0.5 + level) / kSkyMapSize.z)).rgb;
}

// What lies behind `distance` metres of air near the sea, seen along `direction`.
vec3 through_air(vec3 radiance, vec3 direction, float distance) {
  vec3 passed = exp(-haze.rgb * distance);
  float turns = (azimuth_of(direction.xy) - sun_direction.w) / (2.0 * kPi);
  vec3 glow = textureLod(haze_map, vec2(turns + 0.5 / kSkyMapSize.x, 0.5), 0.0).rgb;
  return mix(glow, radiance, passed);
}

// Water without end under the surface, seen along `direction`.
vec3 water_body(vec3 direction) { return 3.0 * water_leaving.rgb * (1.0 + 0.6 * direction.z); }

// Share of light that comes through `distance` metres of water.
vec3 water_passed(float distance) { return exp(-distance * vec3(0.30, 0.09, 0.07)); }
