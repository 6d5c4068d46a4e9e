"""Published statements with their computed counterparts."""
