"""What a person has set: quantities, scene, steps to undo, address, lessons. No drawing."""
