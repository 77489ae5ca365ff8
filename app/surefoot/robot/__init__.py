"""What the robot is: joints by name, limits, feet, state. One number lives in one place, ``robot_models/``."""
