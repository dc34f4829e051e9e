"""For study: methods side by side, what accuracy costs, what a drawing reached. No drawing needs it."""
