touchstone_test(touch_pipeline_tests
    SOURCES cross_step_test.cpp finger_cover_test.cpp finger_shape_test.cpp fingertip_detection_test.cpp fingertip_tracking_test.cpp height_minima_test.cpp
        local_drift_test.cpp low_end_test.cpp named_areas_test.cpp table_picture_test.cpp touch_bias_test.cpp touch_detection_test.cpp
    LIBRARIES touchstone_pipeline)
