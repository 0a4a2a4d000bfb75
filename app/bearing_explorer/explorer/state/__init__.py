"""State that a person has set: fields, scene, steps to undo, address, lessons. No drawing."""
