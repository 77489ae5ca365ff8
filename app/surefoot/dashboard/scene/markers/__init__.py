"""What the theory talks about, drawn into the 3D area: one class for each thing that can be shown or hidden."""
