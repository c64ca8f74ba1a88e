touchstone_library(touchstone_held_accuracy held_run.cpp)
target_link_libraries(touchstone_held_accuracy PUBLIC touchstone_pipeline touchstone_path_accuracy
    touchstone_surface_accuracy touchstone_simulator)

add_executable(score_held score_held.cpp)
target_link_libraries(score_held PRIVATE touchstone_held_accuracy CLI11::CLI11)
target_compile_definitions(score_held PRIVATE TOUCHSTONE_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
touchstone_warnings(score_held)
