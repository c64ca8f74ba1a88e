touchstone_test(pipeline_tracking_test
    SOURCES pose_solver_test.cpp
    LIBRARIES touchstone_pipeline)
