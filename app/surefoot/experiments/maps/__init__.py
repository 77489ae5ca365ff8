"""Maps of survival: where stones, pushes and swings are survived, drawn beside what physics allows."""
