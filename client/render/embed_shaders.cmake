# Writes OUTPUT, a C++ file that holds the text of every shader in SHADERS (paths, separated by |).
string(REPLACE "|" ";" SHADERS "${SHADERS}")
set(entries "")
foreach(path IN LISTS SHADERS)
  get_filename_component(name "${path}" NAME)
  file(READ "${path}" text)
  string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include <utility>

#include \"client/render/shader_program.h\"
#include \"common/base/check.h\"

namespace onesea::render {

std::string_view EmbeddedShader(std::string_view name) {
  static constexpr std::pair<std::string_view, std::string_view> kShaders[] = {
${entries}  };
  for (const auto& [known, text] : kShaders) {
    if (known == name) return text;
  }
  ONESEA_CHECK(false) << \"no shader \" << name;
  return {};
}

}  // namespace onesea::render
")
