"""What comes out, as records: drawings, lines, curves, notes, pictures. They know neither the pipeline nor a writer."""
