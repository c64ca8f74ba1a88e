# Run by touchstone_embed_text at build time. Inputs: VARIABLE, HEADER, SOURCE, FILES, ROOT, FOLDER.
set(entries "")
foreach(file IN LISTS FILES)
    file(READ ${FOLDER}/${file} text)
    # A raw string literal may hold 64 KiB in other compilers; 8 KiB pieces are joined by the compiler.
    string(LENGTH "${text}" length)
    set(pieces "")
    set(at 0)
    while(at LESS length)
        string(SUBSTRING "${text}" ${at} 8000 piece)
        string(APPEND pieces "R\"TEXT(${piece})TEXT\"\n")
        math(EXPR at "${at} + 8000")
    endwhile()
    file(RELATIVE_PATH path ${ROOT} ${FOLDER}/${file})
    string(APPEND entries "    {\"${file}\", \"${path}\",\n${pieces}    },\n")
endforeach()
file(WRITE ${HEADER}.tmp "#pragma once

#include <span>
#include <string_view>

namespace touchstone {

/// One text file of the source tree, embedded at build time.
struct ${VARIABLE}_file {
    std::string_view name;
    std::string_view path;
    std::string_view text;
};

std::span<const ${VARIABLE}_file> ${VARIABLE}();

}  // namespace touchstone
")
file(WRITE ${SOURCE}.tmp "#include \"${VARIABLE}.hpp\"

namespace touchstone {

std::span<const ${VARIABLE}_file> ${VARIABLE}() {
    static constexpr ${VARIABLE}_file files[] = {
${entries}    };
    return files;
}

}  // namespace touchstone
")
configure_file(${HEADER}.tmp ${HEADER} COPYONLY)
configure_file(${SOURCE}.tmp ${SOURCE} COPYONLY)
