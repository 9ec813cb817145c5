"""What all pages share: the HTML page, the style of pictures, titles of effects and faults."""
