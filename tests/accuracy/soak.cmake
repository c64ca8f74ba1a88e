touchstone_library(touchstone_soak soak_run.cpp)
target_link_libraries(touchstone_soak PUBLIC touchstone_accuracy PRIVATE touchstone_system nlohmann_json::nlohmann_json fmt::fmt)

add_executable(soak soak.cpp)
target_link_libraries(soak PRIVATE touchstone_soak CLI11::CLI11 fmt::fmt)
touchstone_warnings(soak)

touchstone_test(soak_test SOURCES soak_test.cpp LIBRARIES touchstone_soak LABELS accuracy)
target_compile_definitions(soak_test PRIVATE TOUCHSTONE_PROGRAM="$<TARGET_FILE:touchstone>")
add_dependencies(soak_test touchstone)
