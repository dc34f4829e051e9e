"""The report as a web page: static files from templates, which a browser shows from disk without a server."""
