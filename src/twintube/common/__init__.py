"""What many rooms use and no room owns.

arrays      the type of arrays, and arrays that nobody can change
words       texts for messages: printable, short, listed
readable    numbers for readers: units and digits
reading     a user's files, opened with bounds
files       files written whole or not at all
caches      folders for what can be made again
processes   workers that end with their parent
extras      what to install where a package is missing
showing     results as a table of pandas and as a picture
parsing     sources as syntax trees
"""
