"""Tools for study: classic methods side by side, the cost of accuracy, measured errors. No drawing needs them."""
