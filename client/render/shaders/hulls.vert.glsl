// Places a corner of a painted hull, and says how high it stands above the water there.
uniform sampler2D water_map;   // per hull: height of the water under it [m], its slopes
uniform int hull;              // texel of water_map
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
out vec3 body;         // place in the body frame [m]
out float depth;       // along the view [m]
out float water_z;     // height of the water here [m]

void main() {
  vec3 world = (world_from_body * vec4(position, 1.0)).xyz;
  vec4 water = texelFetch(water_map, ivec2(hull, 0), 0);
  float above = world.z - water.x - dot(water.yz, world.xy - world_from_body[3].xy);
  water_z = world.z - above;
  facing = mat3(world_from_body) * normal;
#if MIRROR
  world.z -= 2.0 * above;
#endif
  world.z -= dot(world.xy, world.xy) / (2.0 * kEarthRadius);
  offset_eye = world - eye.xyz;
  paint = albedo * mix(vec3(1.0), colour, finish.y);
  gloss_above = vec2(finish.x, above);
  body = position;
  gl_Position = clip_from_world * vec4(world, 1.0);
  depth = gl_Position.w;
  gl_Position.z = -kNearest;  // over w: falls with the reciprocal distance, straight across a face
}
