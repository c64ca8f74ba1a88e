touchstone_library(touchstone_mask_accuracy mask_picture.cpp mask_run.cpp)
target_link_libraries(touchstone_mask_accuracy PUBLIC touchstone_accuracy touchstone_image)

add_executable(score_segmentation score_segmentation.cpp)
target_link_libraries(score_segmentation PRIVATE touchstone_mask_accuracy CLI11::CLI11)
target_compile_definitions(score_segmentation PRIVATE TOUCHSTONE_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
touchstone_warnings(score_segmentation)

touchstone_test(mask_run_test SOURCES mask_run_test.cpp LIBRARIES touchstone_mask_accuracy LABELS accuracy)
target_compile_definitions(mask_run_test PRIVATE TOUCHSTONE_PROGRAM="$<TARGET_FILE:touchstone>")
add_dependencies(mask_run_test touchstone)
