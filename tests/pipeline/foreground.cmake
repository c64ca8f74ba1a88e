touchstone_test(foreground_tests
    SOURCES foreground_model_test.cpp foreground_pipeline_test.cpp moving_volume_test.cpp
    LIBRARIES touchstone_pipeline touchstone_simulator)
