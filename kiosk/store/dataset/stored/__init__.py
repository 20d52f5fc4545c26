"""What there is to be exported: the sittings as they can still be read, and what was put together from them."""
