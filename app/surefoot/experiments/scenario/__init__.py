"""What is simulated: scenario files, their references and postures, and a simulation built from them."""
