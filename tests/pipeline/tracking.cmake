touchstone_test(pipeline_tracking_test
    SOURCES camera_tracking_test.cpp camera_watch_test.cpp moving_parts_test.cpp gray_code_test.cpp pose_solver_test.cpp projector_fit_test.cpp projector_sessions_test.cpp projector_squares_test.cpp reconstruction_test.cpp
        step_filter_test.cpp tracking_states_test.cpp
    LIBRARIES touchstone_pipeline)
