"""Who is right where two drawings of one model differ: judged by rays on the model."""
