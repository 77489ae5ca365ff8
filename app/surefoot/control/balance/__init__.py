"""From the ZMP to the ankles: support, admissible ZMP, the ankle law (28), the capture guard."""
