# The one place that sets warnings: every target of the project takes them.
function(touchstone_warnings target)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Werror)
endfunction()

# A static library of the project: warnings on, includes written from the top of the tree.
function(touchstone_library target)
    add_library(${target} STATIC ${ARGN})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
    touchstone_warnings(${target})
endfunction()
