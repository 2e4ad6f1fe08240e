// Painted hulls in sun and sky light, cut off where the sea stands before them.
// With MIRROR, what is above the water as the water shows it, upside down.
uniform sampler2D stain_map;
in vec3 offset_eye;
in vec3 facing;
in vec3 paint;
in vec2 gloss_above;
in vec3 body;
in float depth;
in float water_z;
layout(location = 0) out vec4 radiance;
#if MIRROR
layout(location = 1) out float mirror_distance;  // to the water that shows this in its mirror [m]
#endif

void main() {
  float distance = length(offset_eye);
#if MIRROR
  float share = gloss_above.y > 0.0 ? 1.0 : 0.0;
#else
  float share = before_sea(distance, depth, offset_eye.z);
#endif
  if (share <= 0.0) discard;
  vec3 direction = offset_eye / distance;
  vec3 n = normalize(facing);
  vec3 v = -direction;
  n = dot(n, v) < 0.0 ? normalize(n - 1.02 * dot(n, v) * v) : n;  // smoothed normals may look away

  // The last hand's breadth above the water is wet, and darker for it.
  float above = gloss_above.y;
#if PLAIN
  vec3 albedo = paint * (0.97 - 0.4 * (1.0 - smoothstep(0.02, 0.17, above)));
#else
  // Nothing afloat is evenly clean: salt, scuffs, and streaks that ran down.
  vec2 skin = vec2(body.x + 0.7 * body.y, body.z + 0.3 * body.y);
  float patchy = texture(stain_map, 0.11 * skin).r, fine = texture(stain_map, vec2(0.9, 0.23) * skin).r;
  float wet = 1.0 - smoothstep(0.02, 0.10 + 0.14 * patchy, above);
  vec3 albedo = paint * (0.80 + 0.22 * patchy + 0.12 * fine) * mix(1.0, 0.55, wet);
  float gloss = mix(gloss_above.x, 0.85, 0.7 * wet);
#endif

  // Light: the sun, the sky's half above, and from below what the water gives back.
  vec3 sea = kPi * water_leaving.rgb + 0.07 * sky_irradiance.rgb;
  float up = 0.5 + 0.5 * n.z;
  // Near the water a face sees the dark side of waves instead of the horizon's sky.
  float open = mix(0.55, 1.0, smoothstep(-0.1, 0.9, above));
  vec3 light = mix(sea, sky_irradiance.rgb * open, up * up * (3.0 - 2.0 * up));
  float lit = max(dot(n, sun_direction.xyz), 0.0);
  vec3 colour = albedo / kPi * (light + sun_irradiance.rgb * lit);

#if PLAIN
  // Varnish mirrors some of the sky.
  float grazing = 1.0 - clamp(dot(n, v), 0.0, 1.0);
  float mirrors = gloss_above.x * (0.035 + 0.5 * gloss_above.x * grazing * grazing * grazing);
  colour = mix(colour, sky_irradiance.rgb * (0.8 / kPi), mirrors);
#else
  // Varnish: a mirror image of sky or sea, stronger at grazing angles; the sun's, spread by gloss.
  float cosine = clamp(dot(n, v), 0.0, 1.0);
  float grazing = 1.0 - cosine;
  float grazing2 = grazing * grazing;
  float fresnel = gloss * (0.035 + 0.7 * gloss * grazing2 * grazing2 * grazing);
  vec3 r = reflect(direction, n);
  vec3 above_sea = sky_at(normalize(vec3(r.xy, abs(r.z) + 0.02)), mix(0.55, 0.04, gloss));
  vec3 seen = mix(water_leaving.rgb + 0.25 * above_sea, above_sea, smoothstep(-0.12, 0.1, r.z));
  colour = mix(colour, seen, fresnel);
  vec3 h = normalize(v + sun_direction.xyz);
  float power = exp2(3.0 + 7.0 * gloss);
  float spot = pow(max(dot(n, h), 0.0), power) * (power + 8.0) / (8.0 * kPi);
  colour += min(sun_irradiance.rgb * (spot * lit * gloss * 0.05), vec3(30.0));
#endif

  if (eye.z < 0.0) {
    colour = mix(water_body(direction), colour, water_passed(distance));
  } else {
    colour = through_air(colour, direction, distance);
  }
  radiance = vec4(colour * share, share);
#if MIRROR
  float height = max(eye.z - water_z, 0.1);
  mirror_distance = distance * height / (height + above);
#endif
}
