touchstone_test(pipeline_view_test
    SOURCES view_rendering_test.cpp
    LIBRARIES touchstone_pipeline)
