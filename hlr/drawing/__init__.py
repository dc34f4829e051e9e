"""The records of a result: drawings, lines, curves, notes, pictures. They import neither the pipeline nor a writer."""
