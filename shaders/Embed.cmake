# cmake -DOUTPUT=FILE -DSHADERS=a;b -P Embed.cmake: writes the table behind EmbeddedShaders.h.
set(code "#include \"weft/shaders/EmbeddedShaders.h\"

namespace weft {

std::span<const EmbeddedShader> embeddedShaders() {
  static constexpr EmbeddedShader table[] = {
")
foreach(shader ${SHADERS})
  cmake_path(GET shader FILENAME name)
  file(READ ${shader} text)
  string(APPEND code "      {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
string(APPEND code "  };\n  return table;\n}\n\n}  // namespace weft\n")
file(WRITE ${OUTPUT} "${code}")
