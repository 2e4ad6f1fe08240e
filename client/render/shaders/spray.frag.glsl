// A soft puff of drops in sun and sky light, fading where the sea or land comes close behind it.
#if SAMPLES > 1
uniform sampler2DMS surface_map;
#else
uniform sampler2D depth_map;
#endif
uniform sampler2D noise_map;
in vec2 corner;
in vec2 noise_at;
in vec3 offset_eye;
in float depth;
in float opacity;
in float soft_m;
out vec4 radiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float distance = length(offset_eye);
#if SAMPLES > 1
  vec4 s = texelFetch(surface_map, pixel, 0);
  float behind = s.w != 0.0 ? abs(s.z) - distance : 1e6;
#else
  float there = texelFetch(depth_map, pixel, 0).r;
  float behind = there < 1.0 ? depth_of(there) - depth : 1e6;
#endif
  float round = max(1.0 - dot(corner, corner), 0.0);
  float torn = texture(noise_map, noise_at).r;
  float cover = opacity * round * smoothstep(0.40, 0.95, torn * 0.75 + 0.45 * round) * clamp(behind / soft_m + 0.35, 0.0, 1.0);
  if (cover < 0.003) discard;

  // Drops scatter forwards (Henyey & Greenstein, g = 0.75); many of them, to all sides.
  vec3 direction = offset_eye / distance;
  float cosine = dot(direction, sun_direction.xyz);
  float forwards = 0.4375 / (4.0 * kPi * pow(1.5625 - 1.5 * cosine, 1.5));
  vec3 light = sun_irradiance.rgb * (0.11 + 0.5 * min(forwards, 0.6)) + sky_irradiance.rgb * 0.27;
  radiance = vec4(through_air(light, direction, distance) * cover, cover);
}
