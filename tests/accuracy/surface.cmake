touchstone_library(touchstone_surface_accuracy
    mesh_alignment.cpp
    mesh_input.cpp
    mesh_picture.cpp
    surface_score.cpp)
target_link_libraries(touchstone_surface_accuracy
    PUBLIC touchstone_pipeline touchstone_image
    PRIVATE touchstone_simulator PkgConfig::ASSIMP nlohmann_json::nlohmann_json)

foreach(program score_surface render_mesh)
    add_executable(${program} ${program}.cpp)
    target_link_libraries(${program} PRIVATE touchstone_surface_accuracy CLI11::CLI11)
    touchstone_warnings(${program})
endforeach()

touchstone_test(surface_accuracy_test
    SOURCES mesh_picture_test.cpp surface_score_test.cpp
    LIBRARIES touchstone_surface_accuracy nlohmann_json::nlohmann_json)

touchstone_test(surface_programs_test
    SOURCES surface_programs_test.cpp
    LIBRARIES touchstone_surface_accuracy nlohmann_json::nlohmann_json)
target_compile_definitions(surface_programs_test PRIVATE TOUCHSTONE_SCORE_SURFACE="$<TARGET_FILE:score_surface>"
    TOUCHSTONE_RENDER_MESH="$<TARGET_FILE:render_mesh>")
add_dependencies(surface_programs_test score_surface render_mesh)
