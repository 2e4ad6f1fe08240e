// Places a corner of a painted hull, and says how high it stands above the water there.
uniform sampler2DArray displacement_map;
uniform sampler2DArray patch_height_map;
uniform mat4 world_from_body;  // world: relative to the eye's horizontal place
uniform vec3 colour;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in vec2 finish;  // gloss, tinted
out vec3 offset_eye;
out vec3 facing;
out vec3 paint;
out vec2 gloss_above;  // gloss; height above the water [m]
out float depth;       // along the view [m]

// Waves that a hull feels: the finest cascades average out over it.
float water_height(vec2 xy) {
  vec2 moved = vec2(0.0);
  float height = 0.0;
  int cascades = int(counts.x);
  for (int step = 0; step < 2; ++step) {
    vec3 sum = vec3(0.0);
    for (int c = 0; c < cascades; ++c) {
      float lod = max(-1.0 - cascade_map[c].w, 0.0);  // half a metre
      sum += textureLod(displacement_map, vec3(tile_coordinate(c, xy - moved), float(c)), lod).xyz;
    }
    int regulars = int(counts.y);
    for (int n = 0; n < regulars; ++n) {
      vec4 wave = regular[n];
      float phase = dot(wave.xy, xy - moved) + wave.w;
      sum += vec3(-water_leaving.w * normalize(wave.xy) * sin(phase), cos(phase)) * wave.z;
    }
    moved = sum.xy;
    height = sum.z;
  }
  int patches = int(counts.w);
  for (int n = 0; n < patches; ++n) height += textureLod(patch_height_map, patch_coordinate(n, xy), 0.0).r;
  return height;
}

void main() {
  vec3 world = (world_from_body * vec4(position, 1.0)).xyz;
  float above = world.z - water_height(world.xy);
  world.z -= dot(world.xy, world.xy) / (2.0 * kEarthRadius);
  offset_eye = world - eye.xyz;
  facing = mat3(world_from_body) * normal;
  paint = albedo * mix(vec3(1.0), colour, finish.y);
  gloss_above = vec2(finish.x, above);
  gl_Position = clip_from_world * vec4(world, 1.0);
  depth = gl_Position.w;
  gl_Position.z = -kNearest;  // over w: falls with the reciprocal distance, straight across a face
}
