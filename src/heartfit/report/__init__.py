"""One page of a whole study: HTML that opens from a file, with everything it shows inside."""
