touchstone_library(touchstone_baselines
    baselines/background.cpp
    baselines/band_touch.cpp
    baselines/blobs.cpp
    baselines/boxcar.cpp
    baselines/direct_depth.cpp
    baselines/direct_fingers.cpp
    baselines/direct_zones.cpp
    baselines/dynamic_background.cpp
    baselines/finger_slices.cpp
    baselines/methods.cpp
    baselines/omni_touch.cpp
    baselines/point_tracker.cpp
    baselines/world_kit.cpp)
target_link_libraries(touchstone_baselines PUBLIC Eigen3::Eigen)

touchstone_test(baselines_test
    SOURCES
        baselines/background_test.cpp
        baselines/band_touch_test.cpp
        baselines/blobs_test.cpp
        baselines/boxcar_test.cpp
        baselines/direct_depth_test.cpp
        baselines/direct_fingers_test.cpp
        baselines/direct_zones_test.cpp
        baselines/dynamic_background_test.cpp
        baselines/finger_slices_test.cpp
        baselines/omni_touch_test.cpp
        baselines/point_tracker_test.cpp
        baselines/world_kit_test.cpp
    LIBRARIES touchstone_baselines)

touchstone_library(touchstone_baseline_accuracy
    bar_chart.cpp
    baseline_run.cpp
    evaluation.cpp
    evaluation_chart.cpp
    evaluation_table.cpp
    touch_series.cpp)
target_link_libraries(touchstone_baseline_accuracy
    PUBLIC touchstone_accuracy touchstone_baselines touchstone_simulator
    PRIVATE fmt::fmt)

add_executable(score_baselines score_baselines.cpp)
target_link_libraries(score_baselines PRIVATE touchstone_baseline_accuracy CLI11::CLI11 fmt::fmt)
touchstone_warnings(score_baselines)

touchstone_test(evaluation_test
    SOURCES bar_chart_test.cpp evaluation_chart_test.cpp evaluation_table_test.cpp evaluation_test.cpp touch_series_test.cpp
    LIBRARIES touchstone_baseline_accuracy)
touchstone_test(baseline_run_test SOURCES baseline_run_test.cpp LIBRARIES touchstone_baseline_accuracy LABELS accuracy)
