touchstone_test(pipeline_objects_test
    SOURCES object_segmentation_test.cpp
    LIBRARIES touchstone_pipeline)
