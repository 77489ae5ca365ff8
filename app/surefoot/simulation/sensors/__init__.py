"""What the robot can measure: ideal signals of the plant, and what real sensors make of them."""
