touchstone_library(touchstone_path_accuracy path_score.cpp)
target_link_libraries(touchstone_path_accuracy PUBLIC touchstone_system Eigen3::Eigen)

add_executable(score_tracking score_tracking.cpp)
target_link_libraries(score_tracking PRIVATE touchstone_path_accuracy touchstone_surface_accuracy touchstone_simulator
    CLI11::CLI11)
target_compile_definitions(score_tracking PRIVATE TOUCHSTONE_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
touchstone_warnings(score_tracking)

touchstone_test(path_score_test SOURCES path_score_test.cpp LIBRARIES touchstone_path_accuracy)

# The recordings whose bars are met, as users run them; skipped where they are not there.
touchstone_test(scored_track_test SOURCES scored_track_test.cpp LIBRARIES touchstone_path_accuracy LABELS accuracy)
target_compile_definitions(scored_track_test PRIVATE TOUCHSTONE_PROGRAM="$<TARGET_FILE:touchstone>")
add_dependencies(scored_track_test touchstone)
