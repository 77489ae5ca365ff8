"""What the robot decides: settings, the contact QP (17), the ankle law (28) and the controllers built from them."""
