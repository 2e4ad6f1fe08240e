// What land and seabed are made of and how they look in daylight. Needs sky.glsl.
uniform sampler2D ground_map;  // elevation, slopes, relief: see client/render/ground_textures.h
uniform sampler2D grain_map;   // noise, its slopes, gaps between stones

// Elevation above the water level and its slopes at a place relative to the eye.
vec4 ground_at(vec2 xy, float lod) {
  vec4 ground = textureLod(ground_map, xy * ground_place.zw + ground_place.xy, lod);
  ground.x -= ground_noise.w;
  return ground;
}

// Repeats `count` times in ground_noise's 4096 m; counts without a common factor never repeat together.
vec4 grain_at(vec2 xy, float count, float footprint_log2) {
  const float kFinest = 3.0;  // log2 of 4096 m over 512 texels
  return textureLod(grain_map, (xy + ground_noise.xy) * (count / 4096.0), max(footprint_log2 + log2(count) - kFinest, 0.0));
}

struct Ground {
  vec3 albedo;
  vec3 normal;
  float wet;   // 0 dry .. 1 covered by a film of water
};

// `ground` as ground_at() gives it. With GROUND_COARSE half as many reads: for what is seen through
// water. The terrain's samples are metres apart: what is finer is noise.
Ground ground_of(vec2 xy, vec4 ground, float footprint_log2) {
  float height = ground.x;
  vec4 broad = grain_at(xy, 5.0, footprint_log2);
  vec4 middle = grain_at(xy.yx, 37.0, footprint_log2);
  vec4 fine = grain_at(xy, 331.0, footprint_log2);
#if GROUND_COARSE
  vec4 stones = fine, tiny = fine;
#else
  vec4 stones = grain_at(xy.yx, 127.0, footprint_log2);
  vec4 tiny = grain_at(xy.yx, 1237.0, footprint_log2);
#endif
  float steep = length(ground.yz);
  float rough = 0.5 * middle.r + 0.3 * fine.r + 0.2 * broad.r;

  // Rock where it is steep, and where it stands high over what is around it, as walls do; on land,
  // grass above the reach of the waves, sand below.
#if GROUND_COARSE
  float wall = 0.0;
#else
  float around = textureLod(ground_map, xy * ground_place.zw + ground_place.xy, max(5.5 - ground_noise.z, 0.0)).x - ground_noise.w;
  float wall = smoothstep(1.2, 2.4, height - max(around, -3.0)) * (1.0 - smoothstep(2.5, 6.0, around));
#endif
  float rock = max(smoothstep(0.34, 0.52, steep + 0.24 * (rough - 0.5)), wall);
  float wash = 0.35 + 0.25 * water_kd.w;  // height that waves reach [m]
  float green = smoothstep(1.1, 2.6, (height - wash) * (1.0 - 0.4 * steep) + 2.0 * (middle.r - 0.5) + (broad.r - 0.5));
  vec3 sand = mix(vec3(0.36, 0.29, 0.19), vec3(0.50, 0.42, 0.30), 0.36 * broad.r + 0.36 * middle.r + 0.18 * stones.r + 0.10 * fine.r);
  vec3 grass = mix(vec3(0.048, 0.066, 0.020), vec3(0.140, 0.130, 0.050), 0.55 * broad.r + 0.45 * middle.r);
  // Bushes in the hollows of the noise.
  float bush = 0.45 * middle.r + 0.30 * broad.r + 0.25 * stones.r;
  grass = mix(grass, vec3(0.022, 0.034, 0.014), smoothstep(0.56, 0.66, bush) * smoothstep(2.0, 7.0, height));
  grass *= 0.72 + 0.25 * fine.r + 0.15 * stones.r + 0.16 * tiny.r;
  // Grains, pebbles and what the last waves left.
  sand *= (0.84 + 0.32 * tiny.r) * (1.0 - 0.3 * smoothstep(0.85, 1.0, fine.r) * smoothstep(0.7, 1.0, tiny.r));
  // Boulders with dark gaps between them.
  float gap = 0.6 * smoothstep(0.5, 0.95, tiny.a) + 0.4 * smoothstep(0.6, 0.95, fine.a);
  vec3 stone = mix(vec3(0.130, 0.122, 0.110), vec3(0.270, 0.252, 0.225), 0.4 * fine.r + 0.3 * middle.r + 0.3 * stones.r);
  stone *= (1.05 - 0.55 * gap) * (0.8 + 0.4 * tiny.r);
  // Seabed: weed in patches on the sand, none where waves stir it.
  float weed = smoothstep(0.50, 0.80, 0.42 * middle.r + 0.38 * broad.r + 0.20 * stones.r) * smoothstep(1.5, 4.0, -height);
  sand = mix(sand, vec3(0.075, 0.080, 0.048), 0.75 * weed);
  vec3 albedo = mix(mix(sand, grass, green), stone, rock);

  // Water darkens what it wets; on rock, weed grows where it is wet every day.
  float reach = wash * (0.45 + 0.5 * middle.r + 0.25 * fine.r);
  float wet = height < 0.0 ? 1.0 : 1.0 - smoothstep(0.4 * reach, reach, height);
  float algae = rock * (1.0 - smoothstep(0.25, 0.55, height - 0.3 * middle.r)) * smoothstep(-3.5, -1.0, height);
  albedo = mix(albedo, vec3(0.034, 0.036, 0.020), 0.75 * algae);
  albedo *= mix(vec3(1.0), vec3(0.50, 0.48, 0.44), wet);

  // Relief: pebbles and ripples of sand, tufts, boulders.
  float bumps = mix(mix(0.10, 0.45, green), 0.9, rock);
  vec2 slope = ground.yz + bumps * (0.9 * (middle.gb - 0.502).yx + 1.3 * (fine.gb - 0.502) + 0.9 * (stones.gb - 0.502).yx + 1.2 * (tiny.gb - 0.502).yx);
  return Ground(albedo, normalize(vec3(-slope, 1.0)), wet);
}

// Radiance towards an eye above the water, without the air between.
vec3 ground_light(Ground g, vec3 direction) {
  float up = 0.5 + 0.5 * g.normal.z;
  vec3 light = sky_irradiance.rgb * up + 0.10 * (1.0 - up) * sun_irradiance.rgb;
  float lit = max(dot(g.normal, sun_direction.xyz), 0.0);
  vec3 colour = g.albedo / kPi * (light + sun_irradiance.rgb * lit);
  // The film of water mirrors the sky.
  vec3 n = normalize(vec3(0.35 * g.normal.xy, g.normal.z));
  float grazing = 1.0 - clamp(-dot(n, direction), 0.0, 1.0);
  float grazing2 = grazing * grazing;
  float film = g.wet * g.wet * (0.02 + 0.5 * grazing2 * grazing2 * grazing);
  vec3 r = reflect(direction, n);
  return mix(colour, sky_at(normalize(vec3(r.xy, abs(r.z) + 0.01)), 0.25), film);
}
