touchstone_test(segmentation_tests
    SOURCES foreground_segmentation_test.cpp column_drift_test.cpp segmentation_recordings_test.cpp
        slow_hand_test.cpp
    LIBRARIES touchstone_pipeline touchstone_image)
