"""What the robot's physics says at one state: one evaluation a tick, one frozen bundle. Pinocchio lives here."""
