# Turns a text file into a C++ string: cmake -DINPUT=file -DOUTPUT=file.cpp -DNAME=kName -P embed.cmake
# The bytes are written as numbers: no limit on a literal's length, nothing to escape.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
file(WRITE ${OUTPUT} "#include <cstddef>
namespace karinui {
extern const char ${NAME}[];
extern const std::size_t ${NAME}Size;
const char ${NAME}[] = {
${bytes}'\\0'};
const std::size_t ${NAME}Size = sizeof(${NAME}) - 1;
}  // namespace karinui
")
