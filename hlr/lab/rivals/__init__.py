"""Other programs that draw the same view: the study and the benches compare hlr with them."""
