"""Walking and stepping: where the feet go, how ZMP and capture point lead there, and which foot carries when."""
