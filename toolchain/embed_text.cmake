# touchstone_embed_text(TARGET VARIABLE FILE...): makes VARIABLE.hpp and VARIABLE.cpp in the build folder, which give
# the named text files (kernels, shaders) as strings, and adds them to TARGET.
function(touchstone_embed_text target variable)
    set(header ${CMAKE_CURRENT_BINARY_DIR}/${variable}.hpp)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${variable}.cpp)
    add_custom_command(
        OUTPUT ${header} ${source}
        COMMAND ${CMAKE_COMMAND} -DVARIABLE=${variable} -DHEADER=${header} -DSOURCE=${source}
                "-DFILES=${ARGN}" -DROOT=${PROJECT_SOURCE_DIR} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR}
                -P ${PROJECT_SOURCE_DIR}/toolchain/embed_text_script.cmake
        DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/toolchain/embed_text_script.cmake
        VERBATIM)
    target_sources(${target} PRIVATE ${source} ${header})
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>)
endfunction()
