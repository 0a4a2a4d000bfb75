"""Numbers from outside the program: each test names where its right value comes from."""
