"""The functions that `import hlr` shows."""
