touchstone_test(pipeline_particles_test
    SOURCES hand_motion_test.cpp particle_simulation_test.cpp particle_table_test.cpp
    LIBRARIES touchstone_pipeline)
