$ Nastran file written by meshio v5.0.0
BEGIN BULK
GRID    1                     0.      0.      1.
GRID    2                     0.      0.      0.
GRID    3                     0.      1.      1.
GRID    4                     0.      1.      0.
GRID    5                     1.      0.      0.
GRID    6                     1.      0.      1.
GRID    7                     1.      1.      1.
GRID    8                     1.      1.      0.
GRID    9                    1.7      0.      1.
GRID    10                   1.7      0.      0.
GRID    11                   1.7      1.      1.
GRID    12                   1.7      1.      0.
GRID    13                    0.     0.5     0.5
GRID    14                    1.     0.5     0.5
GRID    15                   0.5      0.     0.5
GRID    16                   0.5      1.     0.5
GRID    17                   0.5     0.5      0.
GRID    18                   0.5     0.5      1.
GRID    19                   1.7     0.5     0.5
GRID    20                  1.35      0.     0.5
GRID    21                  1.35      1.     0.5
GRID    22                  1.35     0.5      0.
GRID    23                  1.35     0.5      1.
CTRIA3  1               2       1       13      
CTRIA3  2               1       3       13      
CTRIA3  3               4       2       13      
CTRIA3  4               3       4       13      
CTETRA  5               16      13      17      14      
CTETRA  6               13      16      18      14      
CTETRA  7               15      17      13      14      
CTETRA  8               18      15      13      14      
CTETRA  9               2       17      4       13      
CTETRA  10              1       13      3       18      
CTETRA  11              4       13      16      3       
CTETRA  12              1       2       13      15      
CTETRA  13              8       7       16      14      
CTETRA  14              1       15      18      6       
CTETRA  15              6       7       14      18      
CTETRA  16              16      3       18      7       
CTETRA  17              17      4       16      8       
CTETRA  18              2       17      15      5       
CTETRA  19              5       6       14      15      
CTETRA  20              5       8       17      14      
CTETRA  21              17      4       13      16      
CTETRA  22              13      16      3       18      
CTETRA  23              2       17      13      15      
CTETRA  24              15      13      1       18      
CTETRA  25              18      16      7       14      
CTETRA  26              15      18      6       14      
CTETRA  27              14      15      17      5       
CTETRA  28              17      16      14      8       
CTETRA  29              11      21      12      19      
CTETRA  30              9       23      11      19      
CTETRA  31              19      22      12      10      
CTETRA  32              19      9       20      10      
CTETRA  33              7       6       14      23      
CTETRA  34              8       7       14      21      
CTETRA  35              6       5       14      20      
CTETRA  36              5       8       14      22      
CTETRA  37              14      21      23      19      
CTETRA  38              23      20      14      19      
CTETRA  39              22      14      20      19      
CTETRA  40              21      14      22      19      
CTETRA  41              23      7       21      14      
CTETRA  42              23      20      6       14      
CTETRA  43              8       21      14      22      
CTETRA  44              20      14      22      5       
CTETRA  45              21      11      23      19      
CTETRA  46              23      9       20      19      
CTETRA  47              22      12      21      19      
CTETRA  48              19      20      22      10      
CTETRA  49              8       12      21      22      
CTETRA  50              5       22      20      10      
CTETRA  51              9       20      6       23      
CTETRA  52              23      7       11      21      
ENDDATA
