"""Other programs that draw the same view: what the study and the benches compare with."""
